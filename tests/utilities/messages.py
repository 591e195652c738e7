#!/usr/bin/env python3
"""Provokes each message of doc/messages.md: text and exit code; and finds each message of the source in it.

    messages.py PROGRAM [MAP_PROGRAM] [--only WORD] [--missing]

A heading of level 3 in doc/messages.md is a message, with an ellipsis where something stands that depends on the problem. The block below it says what
provokes it:

    ```provoke PROBLEM [code=N]
    Section/Name=value                   a parameter
    --option value                       an option of the program
    s|old text|new text|                 a change of the problem's file; \\n is a new line
    file NAME|text                       a file beside it; \\n is a new line
    run arguments                        a run of the program before this one
    ```

Instead of a block a line "Provoked by: " names another test, or why none can. PROBLEM is a file of prm/ or one of the short names below, `none`, or `map` for signorini-map. Without `code` the exit code is 1. Entries with `code=0` or 3 are notes and warnings on
the terminal; all others are one line on stderr, and leave no results.
"""
import concurrent.futures
import glob
import os
import re
import shlex
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(TOP, 'tests', 'application'))
from harness import Program  # noqa: E402

CATALOGUE = os.path.join(TOP, 'doc', 'messages.md')
ELLIPSIS = '…'
SHORT = {'blocks': 'patch_test/patch_test.prm', 'obstacle': 'obstacle/paraboloid.prm', 'fit': 'shapes/press-fit.prm', 'deck': 'deck/press.inp'}


def plain(text):
    return ' '.join(text.split())


def entries():
    """(line, heading, [(problem, code, lines)])"""
    result, block = [], None
    with open(CATALOGUE, encoding='utf-8') as f:
        for number, line in enumerate(f, 1):
            line = line.rstrip('\n')
            if block is not None:
                if line == '```':
                    block = None
                else:
                    block.append(line)
            elif line.startswith('Provoked by: '):
                result[-1][2].append(line)
            elif line.startswith('```provoke'):
                words = line.split()[1:]
                code = [int(w[5:]) for w in words if w.startswith('code=')]
                block = []
                words[0] = SHORT.get(words[0], words[0])
                result[-1][2].append((words[0], code[0] if code else 1, block))
            elif line.startswith('### '):
                result.append((number, line[4:].replace('\\*', '*').replace('\\_', '_').replace('\\<', '<'), []))
    return result


def pattern(heading):
    return re.compile(r'.*?'.join(re.escape(plain(part)).replace(r'\ ', r'\s+') for part in heading.split(ELLIPSIS)), re.DOTALL)


def unescape(text):
    return text.replace('\\n', '\n').replace('\\0', '\0')


def set_up(folder, problem, lines, commands):
    """Puts the problem and its files into the folder; returns the arguments of the run."""
    file, arguments = None, []
    if problem not in ('none', 'map'):
        source = os.path.join(TOP, 'prm', problem)
        file = os.path.basename(problem)
        for name in os.listdir(os.path.dirname(source)):
            if name != file and os.path.isfile(os.path.join(os.path.dirname(source), name)):
                os.symlink(os.path.join(os.path.dirname(source), name), os.path.join(folder, name))
        with open(source) as f:
            text = f.read()
        for line in lines:
            if line.startswith('s|'):
                old, new = map(unescape, (line[2:-1] if line.endswith('|') else line[2:]).split('|'))
                if old not in text:
                    raise ValueError(f'"{old}" is not in {problem}')
                text = text.replace(old, new, 1)
        with open(os.path.join(folder, file), 'w') as f:
            f.write(text)
        arguments.append(file)
    for line in lines:
        if line.startswith('file '):
            name, text = line[5:].split('|', 1)
            os.makedirs(os.path.join(folder, os.path.dirname(name)), exist_ok=True)
            with open(os.path.join(folder, name), 'w') as f:
                f.write(unescape(text))
        elif line.startswith('run '):
            commands.append(shlex.split(line[4:]))
        elif line.startswith('s|') or not line:
            pass
        elif line.startswith('-') or problem in ('none', 'map'):
            arguments += shlex.split(line)
        else:
            arguments += ['--set', line]
    if file and '--output' not in arguments:
        arguments += ['--output', 'out']
    return arguments


def provoke(programs, problem, code, lines):
    """What a run says, and complaints about how it ends."""
    program = programs['map' if problem == 'map' else 'run']
    with tempfile.TemporaryDirectory() as folder:
        commands = []
        try:
            arguments = set_up(folder, problem, lines, commands)
        except ValueError as error:
            return '', [str(error)]
        for command in commands + [arguments]:
            run = Program(program, 1).call(*command, cwd=folder)
        said = run.stdout + run.stderr
        complaints = []
        if run.returncode != code:
            complaints.append(f'exit code {run.returncode}, not {code}')
        if code == 1 and run.stderr.count('error:') != 1:
            complaints.append('not one message')
        if code == 1 and 'results in' not in said and not commands and os.path.isdir(os.path.join(folder, 'out')):
            complaints.append('results are left')
        return said, complaints


# Calls that make a message: input errors, the refusals of decks, notes of a run.
CALL = re.compile(r'\b(?:InputError|fail|refuse|differ|note|push_back)\(')


def statements(text):
    """(line, text of the call) of all messages in a source file; literals that follow each other are joined."""
    for m in CALL.finditer(text):
        depth, quoted, i = 1, False, m.end()
        while depth and i < len(text):
            c = text[i]
            if quoted:
                if c == '\\':
                    i += 1
                elif c == '"':
                    quoted = False
            elif c == '"':
                quoted = True
            depth += (c == '(') - (c == ')') if not quoted else 0
            i += 1
        yield text.count('\n', 0, m.start()) + 1, re.sub(r'"\s+"', '', text[m.end():i - 1])


def literals(code):
    return [re.sub(r'\\(.)', lambda m: {'n': ' '}.get(m.group(1), m.group(1)), s) for s in re.findall(r'"((?:[^"\\]|\\.)*)"', code)]


def source_messages():
    """(file, line, longest literal) of the messages that a user may see."""
    for folder, _, names in os.walk(os.path.join(TOP, 'source')):
        for name in sorted(names):
            if not name.endswith(('.cc', '.h')):
                continue
            path = os.path.join(folder, name)
            with open(path) as f:
                text = f.read()
            for line, code in statements(text):
                found = max(literals(code), key=len, default='')
                # A push_back of a short word is a list of names.
                if len(found) >= 12 and ' ' in found:
                    yield os.path.relpath(path, TOP), line, plain(found)
            # What streams put together, from their declaration to where they are used.
            for m in re.finditer(r'std::ostringstream\s+(?:text|message);(.*?)\.str\(\)', text, re.DOTALL):
                found = max(literals(re.sub(r'"\s+"', '', m.group(1))), key=len, default='')
                if len(found) >= 12 and ' ' in found:
                    yield os.path.relpath(path, TOP), text.count('\n', 0, m.start()) + 1, plain(found)


def missing(headings):
    """Messages of the source without an entry. Those that are no message for users stand in the last part of the catalogue, in code."""
    with open(CATALOGUE, encoding='utf-8') as f:
        others = plain(f.read().split('## Inside', 1)[-1])
    known = [plain(h).replace(ELLIPSIS, '\0') for h in headings]
    for file, line, text in source_messages():
        piece = text.strip(' .:,;"()')
        if not any(piece in h for h in known) and piece not in others:
            yield f'{file}:{line}: "{text}" has no entry in doc/messages.md'


def named_tests(catalogue):
    """Complaints about tests that entries name and that are not there."""
    known = ''
    for file in glob.glob(os.path.join(TOP, 'tests', '*', '*.cmake')):
        with open(file) as f:
            known += f.read()
    for line, _, blocks in catalogue:
        for block in blocks:
            if isinstance(block, str):
                for name in re.findall(r'test `\w+/(\w+)`', block):
                    if not re.search(rf'\b{name}\b', known):
                        yield f'line {line}: there is no test {name}'


def provoke_all(programs, catalogue):
    """Complaints; entries that the same run provokes share it."""
    headings = {}
    for line, heading, blocks in catalogue:
        for block in blocks:
            if not isinstance(block, str):
                headings.setdefault((block[0], block[1], tuple(block[2])), []).append((line, heading))
    with concurrent.futures.ThreadPoolExecutor(max(2, os.cpu_count() or 2)) as pool:
        for block, (said, complaints) in zip(headings, pool.map(lambda block: provoke(programs, *block), headings)):
            for line, heading in headings[block]:
                wrong = complaints + ([] if pattern(heading).search(plain(said)) else ['says something else'])
                if wrong:
                    yield f'line {line}, "{heading}" by {block[0]} {list(block[2])}: ' + '\n    '.join(wrong + [said[-900:]])


def main():
    arguments = [a for a in sys.argv[1:] if not a.startswith('--')]
    only = sys.argv[sys.argv.index('--only') + 1] if '--only' in sys.argv else ''
    if only:
        arguments.remove(only)
    catalogue = entries()
    complaints = [] if only else list(missing([h for _, h, _ in catalogue])) + list(named_tests(catalogue))
    catalogue = [entry for entry in catalogue if only in entry[1]]
    complaints += [f'line {line}: nothing provokes "{heading}"' for line, heading, blocks in catalogue if not blocks]
    if '--missing' not in sys.argv:
        programs = {'run': os.path.abspath(arguments[0]), 'map': os.path.abspath(arguments[1] if len(arguments) > 1 else arguments[0] + '-map')}
        complaints += provoke_all(programs, catalogue)
    n_elsewhere = sum(any(isinstance(block, str) for block in blocks) for _, _, blocks in catalogue)
    print(f'{len(catalogue)} messages: {len(catalogue) - n_elsewhere} provoked here, {n_elsewhere} by other tests or by nothing that a test can do')
    print('\n'.join(complaints))
    return bool(complaints)


if __name__ == '__main__':
    sys.exit(main())
