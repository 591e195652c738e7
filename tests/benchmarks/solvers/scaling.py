#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors

"""Times of the phases of the last mesh on several numbers of ranks, as a table in Markdown.

    scaling.py PROGRAM [--ranks 1,2] [--repeat 3] [--weak] [FILE.prm [NAME=VALUE ...]]

The smallest of several runs in turns counts: machines are noisy. --weak refines once more globally for each
eight times the ranks (1, 8, 64). Peak memory is that of all ranks together.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
PHASES = ["mesh", "mapping", "mortar", "assembly", "levels", "hierarchy", "solve", "output"]


def run(program, ranks, prm, settings):
    """The summary of a run."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to",
                   "core" if ranks <= os.cpu_count() else "none", "-np", str(ranks), program, prm]
        for setting in settings + ["Output/Folder=" + folder + "/out"]:
            command += ["--set", setting]
        environment = dict(os.environ, OMP_NUM_THREADS="1")
        if ranks > os.cpu_count():
            environment["OMPI_MCA_mpi_yield_when_idle"] = "1"
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{ranks} ranks: {done.stdout[-2000:]}{done.stderr[-2000:]}")
        return json.loads(pathlib.Path(folder, "out", "summary.json").read_text())


def merge(best, summary):
    """The smallest times of both."""
    cycle = summary["cycles"][-1]
    times = {phase: cycle["times_s"].get(phase, 0.) for phase in PHASES}
    times["whole run"] = summary["wall_time_s"]
    best.setdefault("iterations", cycle["nonlinear"]["iterations"])
    best.setdefault("active", cycle["active_nodes"])
    best.setdefault("unknowns", cycle["dofs"])
    best["bytes"] = min(best.get("bytes", 1e99), summary["peak_memory_bytes"])
    for phase, time in times.items():
        best[phase] = min(best.get(phase, 1e99), time)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--ranks", default="1,2")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--weak", action="store_true")
    parser.add_argument("problem", nargs="*", default=[])
    options = parser.parse_args()
    prm = options.problem[0] if options.problem else str(ROOT / "prm/hertz/hertz.prm")
    settings = options.problem[1:] + ["Solver/Compare linear multigrid=false"]
    all_ranks = [int(n) for n in options.ranks.split(",")]
    best = {n: {} for n in all_ranks}
    for _ in range(options.repeat):
        for n in all_ranks:
            levels = {1: 0, 8: 1, 64: 2}[n] if options.weak else 0
            more = [f"Refinement/Final global cycles={levels}"] if options.weak else []
            merge(best[n], run(options.program, n, prm, settings + more))

    print("| | " + " | ".join(f"{n} ranks" for n in all_ranks) + " |")
    print("|---|" + "---|" * len(all_ranks))
    for name in ["unknowns", "iterations", "active"]:
        print(f"| {name} | " + " | ".join(str(best[n][name]) for n in all_ranks) + " |")
    for name in PHASES + ["whole run"]:
        first = best[all_ranks[0]][name]
        print(f"| {name}, s | " + " | ".join(
            f"{best[n][name]:.3f}" + (f" ({first / best[n][name]:.2f})" if n != all_ranks[0] else "")
            for n in all_ranks) + " |")
    print("| memory, bytes an unknown | " +
          " | ".join(f"{best[n]['bytes'] / best[n]['unknowns']:.0f}" for n in all_ranks) + " |")


if __name__ == "__main__":
    main()
