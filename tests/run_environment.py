"""The environment of runs in tests."""
import os
import tempfile

# Folders of MPI: where runs share one, the end of one may take it away while another begins.
SESSIONS = tempfile.TemporaryDirectory(prefix='mpi-')


def session_folder(folder):
    """Where MPI keeps its session, for versions before 5 and from there on."""
    return {'OMPI_MCA_orte_tmpdir_base': folder, 'PRTE_MCA_prte_tmpdir_base': folder}


def run_environment():
    """For one run: memory alone, without a search for networks and a daemon at each start (0.3 s); ranks that wait leave the core to others."""
    return dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1',
                # More ranks than cores, for versions before 5 and from there on.
                OMPI_MCA_rmaps_base_oversubscribe='1', PRTE_MCA_rmaps_default_mapping_policy=':oversubscribe',
                OMPI_MCA_btl_vader_single_copy_mechanism='none',
                OMPI_MCA_pml='ob1', OMPI_MCA_btl='self,vader', OMPI_MCA_mpi_yield_when_idle='1',
                OMPI_MCA_ess_singleton_isolated='1', **session_folder(tempfile.mkdtemp(dir=SESSIONS.name)))
