#!/usr/bin/env python3
"""Compiles all sources of a build folder with clang as far as warnings go (no objects), and fails if there are any.

    contrib/utilities/clang_warnings.py BUILD [FILES...]

BUILD holds a compile_commands.json of CMake; with SIGNORINI_UNITY=ON there the check takes a quarter of the time. FILES are parts of paths:
only sources with one of them in their path are checked. CLANG names the compiler (default: clang++, or Debian 12's clang++-14),
JOBS how many run at a time.
"""
import concurrent.futures, json, os, pathlib, shlex, shutil, subprocess, sys, tempfile

top = pathlib.Path(__file__).resolve().parents[2]
header = top / "source/precompiled.h"


def arguments_of(entry):
    """Of a command of gcc: what clang understands, without output, launcher and gcc's precompiled header."""
    words = shlex.split(entry["command"])
    kept, i = [], 0
    while i < len(words):
        word = words[i]
        if word in ("-isystem", "-I", "-D"):
            kept += words[i:i + 2]
            i += 1
        elif word.startswith(("-I", "-D", "-W", "-std=", "-O")) or word == "-pedantic":
            kept.append(word)
        i += 1
    return kept + ["-Wno-unknown-warning-option"]


def check(clang, arguments, entry, precompiled):
    command = [clang, *arguments, "-include-pch", precompiled, "-fsyntax-only", entry["file"]]
    done = subprocess.run(command, cwd=entry["directory"], capture_output=True, text=True)
    return done.returncode, done.stderr


def main():
    if len(sys.argv) < 2 or not (pathlib.Path(sys.argv[1]) / "compile_commands.json").is_file():
        sys.exit(__doc__)
    clang = os.environ.get("CLANG") or shutil.which("clang++") or shutil.which("clang++-14")
    if not clang:
        sys.exit("clang_warnings: no clang++ found; install the package clang, or name it in CLANG.")
    entries = json.loads((pathlib.Path(sys.argv[1]) / "compile_commands.json").read_text())
    entries = [e for e in entries if "cmake_pch" not in e["file"] and "/precompiled.cc" not in e["file"]]
    if sys.argv[2:]:
        entries = [e for e in entries if any(part in e["file"] for part in sys.argv[2:])]
    if not entries:
        sys.exit("clang_warnings: no source to check.")
    n_bad = 0
    with tempfile.TemporaryDirectory() as folder:
        precompiled = f"{folder}/precompiled.pch"
        subprocess.run([clang, *arguments_of(entries[0]), "-x", "c++-header", str(header), "-o", precompiled], check=True,
                       cwd=entries[0]["directory"])
        with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count()))) as pool:
            checks = {pool.submit(check, clang, arguments_of(e), e, precompiled): e for e in entries}
            for done in concurrent.futures.as_completed(checks):
                code, text = done.result()
                if code != 0 or "warning:" in text:
                    n_bad += 1
                    print(f"== {checks[done]['file']}\n{text}", flush=True)
    print(f"clang_warnings: {len(entries)} sources, {n_bad} with warnings or errors")
    return n_bad > 0


if __name__ == "__main__":
    sys.exit(main())
