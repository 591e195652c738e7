"""Names and folders as people have them: spaces, umlauts, folders in which nothing can be written."""
import json
import os
import shutil
import subprocess
import tempfile

from harness import TOP, check
from run_environment import session_folder
from tool_cases import PATCH_TEST, tree

SMALL = ('--set', 'Refinement/Global cycles=0', '--set', 'Solver/Compare linear multigrid=false')
CORPUS = os.path.join(TOP, 'tests', 'fuzz', 'corpus')


def summary_of(folder):
    with open(os.path.join(folder, 'summary.json')) as f:
        return json.load(f)


def names_of_all_kinds(p):
    """Parameter file, mesh, surface, deck with a part of it, and output in folders with spaces, quotes and letters of all kinds."""
    with tempfile.TemporaryDirectory() as top:
        folder = os.path.join(top, 'Prüf lauf "1" 日本')
        os.mkdir(folder)
        out, prm = os.path.join(folder, 'Ausgabe für alle'), os.path.join(folder, 'Größe & Maß.prm')
        shutil.copy(os.path.join(CORPUS, 'mesh', 'hex-4.1-text.msh'), os.path.join(folder, 'Würfel 1 (neu).msh'))
        with open(os.path.join(folder, "Fläche '2'.off"), 'w') as f:
            f.write('OFF\n4 2 0\n-1 -1 1\n2 -1 1\n2 2 1\n-1 2 1\n3 0 1 2\n3 0 2 3\n')
        with open(PATCH_TEST) as f:
            text = f.read()
        upper = ('  set Mesh            = Würfel 1 (neu).msh\n  set Boundary shapes = top: file: Fläche \'2\'.off\n'
                 '  set Dirichlet       = top: (0, 0, -0.01)\n')
        begin = text.index('  set Mesh          = block\n')
        end = text.index('end', begin)
        with open(prm, 'w') as f:
            f.write(text[:begin] + upper + '  set Young modulus   = 1000\n' + text[end:])
        run = p.call(prm, '--output', out, *SMALL)
        check(run.returncode == 0, f'{prm}: exit code {run.returncode}: {run.stderr}')
        check(os.path.exists(out) and summary_of(out)['converged'], f'no results: {os.listdir(folder)}')
        check(not [name for name in os.listdir(folder) if '.part' in name], f'left: {os.listdir(folder)}')
        # What is missing is named as it was written.
        run = p.call('--check', prm, '--set', 'Body upper/Mesh=Würfel 2.msh')
        check(run.returncode == 1 and 'Würfel 2.msh' in run.stderr, f'missing mesh: {run.stderr}')
        # A deck, a part of which is in another folder.
        with open(os.path.join(CORPUS, 'deck', 'blocks.inp')) as f:
            deck = f.read()
        begin, end = deck.index('*NODE'), deck.index('*ELEMENT')
        os.mkdir(os.path.join(folder, 'Teile (alt)'))
        with open(os.path.join(folder, 'Teile (alt)', 'Knoten ä.inp'), 'w') as f:
            f.write(deck[begin:end])
        with open(os.path.join(folder, 'Modell ö.inp'), 'w') as f:
            f.write(deck[:begin] + '*INCLUDE, INPUT=Teile (alt)/Knoten ä.inp\n' + deck[end:])
        run = p.call(os.path.join(folder, 'Modell ö.inp'), '--output', out)
        check(run.returncode == 0 and summary_of(out)['converged'], f'deck: exit code {run.returncode}: {run.stderr}')


def long_texts(p):
    """Lines, names and numbers that no person writes: one message that a person can read, at once."""
    long = 200000
    dirichlet = 'set Bodies = a\nsubsection Body a\n  set Dirichlet = top: (0, 0, {})\nend\n'
    with tempfile.TemporaryDirectory() as folder:
        prm = os.path.join(folder, 'long.prm')
        for text in ('x' * long, 'set Bodies = ' + 'x' * long + '\nset x = 1\n', 'subsection Body a\n' * long, '\0' * long, '(' * long, 'set ' + '=' * long,
                     'set Bodies = a\nsubsection Body a\n  set Lower corner = [List of <[Double' + 'x' * long + '\nend\n',
                     'set Bodies = ' + ', '.join(f'body {i} ' + 'of many ' * 20 for i in range(300)) + '\nsubsection Ball\nend\n',
                     dirichlet.format('(' * long + '1' + ')' * long), dirichlet.format('^'.join('2' * long)), dirichlet.format('9' * long + '*x')):
            with open(prm, 'w') as f:
                f.write(text)
            run = p.call('--check', prm)
            what = f'{text[:60]}...'
            check(run.returncode == 1 and run.stderr.count('signorini: error: ') == 1, f'{what}: exit code {run.returncode}: {run.stderr[:1000]}')
            check(len(run.stderr) < 2600, f'{what}: a message of {len(run.stderr)} characters: {run.stderr[:300]}')


class Nobody:
    """Runs the program as somebody without rights: root may write everywhere."""

    def __init__(self, p, folder):
        os.chmod(folder, 0o755)
        self.program, self.prm = os.path.join(folder, 'signorini'), os.path.join(folder, 'problem.prm')
        shutil.copy(p.command[0], self.program)
        shutil.copy(PATCH_TEST, self.prm)
        os.chmod(self.program, 0o755)
        os.chmod(self.prm, 0o644)
        sessions = os.path.join(folder, 'sessions')
        os.mkdir(sessions)
        os.chmod(sessions, 0o777)
        self.environment = dict(p.environment, HOME='/', **session_folder(sessions))

    @staticmethod
    def become():
        if os.geteuid() == 0:
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)

    def call(self, *arguments):
        return subprocess.run([self.program, *arguments], env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              universal_newlines=True, timeout=300, preexec_fn=self.become)


def read_only_folders(p):
    """Where nothing can be written that is said before anything is computed, and what is there stays; reading works."""
    with tempfile.TemporaryDirectory() as top:
        nobody = Nobody(p, top)
        work = os.path.join(top, 'work')
        out = os.path.join(work, 'out')
        os.mkdir(work)
        os.chmod(work, 0o777)
        run = nobody.call(nobody.prm, '--output', out, *SMALL)
        check(run.returncode == 0, f'first run: exit code {run.returncode}: {run.stderr}')
        before = tree(work)
        # The results alone, or the folder around them as well.
        for locked in ([out], [out, work]):
            modes = [os.stat(folder).st_mode for folder in locked]
            for folder in locked:
                os.chmod(folder, 0o555)
            run = nobody.call(nobody.prm, '--output', out, *SMALL)
            check(run.returncode == 1, f'{locked}: exit code {run.returncode}: {run.stderr}')
            check(run.stderr.count('signorini: error: Output folder: ') == 1 and out in run.stderr, f'{locked}: {run.stderr}')
            check('linear multigrid' not in run.stdout and 'cycle' not in run.stdout, f'{locked}: computed before it was said: {run.stdout}')
            check(nobody.call('--check', nobody.prm).returncode == 0, f'{locked}: --check')
            for folder, mode in zip(locked, modes):
                os.chmod(folder, mode)
            check(tree(work) == before and os.listdir(work) == ['out'], f'{locked}: changed {os.listdir(work)}')
        # A new folder in one that is locked.
        os.chmod(work, 0o555)
        run = nobody.call(nobody.prm, '--output', os.path.join(work, 'new'), *SMALL)
        check(run.returncode == 1 and 'folder not yours?' in run.stderr, f'new folder: {run.returncode}, {run.stderr}')
        os.chmod(work, 0o777)
        check(os.listdir(work) == ['out'], f'new folder: {os.listdir(work)}')
