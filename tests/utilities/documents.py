#!/usr/bin/python3
"""The documents: links and anchors, spelling, and every command and parameter file in them.

    documents.py links
    documents.py spelling
    documents.py parameters PROGRAM          the generated reference has every parameter
    documents.py run PROGRAM [FILE.md ...]   without a file: all documents that have commands

Commands stand in blocks ```bash, which are run one after the other in a copy of the source folder, each document in a copy of its own; parameter files
in blocks ```prm: `<!-- file: NAME -->` above a block stores it under this name for the commands, others are fragments whose names must be declared.
`<!-- not run: REASON -->` above a block leaves it out (what installs packages, needs a cluster, takes minutes); a line "exit code N" in the comment
`<!-- exit code: N -->` says that the last command ends so.
"""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(TOP, 'tests', 'application'))
sys.path.insert(0, os.path.join(TOP, 'contrib', 'utilities'))
import parameter_reference  # noqa: E402
from harness import Program  # noqa: E402

# Pages that are made when the site is.
GENERATED = ('doc/parameters.md',)


def documents():
    files = subprocess.run(['git', '-C', TOP, 'ls-files', '--cached', '--others', '--exclude-standard', '*.md'], stdout=subprocess.PIPE,
                           universal_newlines=True).stdout.split('\n') if os.path.exists(os.path.join(TOP, '.git')) else []
    files = [f for f in files if f] or [os.path.relpath(f, TOP) for f in glob.glob(os.path.join(TOP, '**', '*.md'), recursive=True)]
    return sorted(f for f in files if not f.startswith(('build', 'output')) and os.path.exists(os.path.join(TOP, f)))


def text_of(document):
    with open(os.path.join(TOP, document), encoding='utf-8') as f:
        return f.read()


def without_code(text):
    """With the same lines."""
    text = re.sub(r'^```.*?^```$', lambda m: '\n' * m.group().count('\n'), text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r'^    .*$', '', text, flags=re.MULTILINE)
    return re.sub(r'`[^`\n]*`', '', text)


def anchors(text):
    """Those that GitHub and MyST give to headings."""
    found = set()
    for heading in re.findall(r'^#+ (.*)$', re.sub(r'^```.*?^```$', '', text, flags=re.DOTALL | re.MULTILINE), re.MULTILINE):
        words = re.sub(r'[^\w\- ]', '', heading.strip().lower())
        found.add(words.replace(' ', '-'))
    return found


def links():
    complaints, n = [], 0
    for document in documents():
        for target in re.findall(r'\]\(([^)\s]+)\)', without_code(text_of(document))):
            if re.match(r'[a-z]+:', target):
                continue
            n += 1
            path, _, anchor = target.partition('#')
            where = os.path.normpath(os.path.join(os.path.dirname(document), path)) if path else document
            if where in GENERATED:
                continue
            if not os.path.exists(os.path.join(TOP, where)):
                complaints.append(f'{document}: there is no "{target}"')
            elif anchor and where.endswith('.md') and anchor not in anchors(text_of(where)):
                complaints.append(f'{document}: "{where}" has no heading "#{anchor}"')
        # Files that are named in code.
        for target in re.findall(r'`((?:doc|prm|contrib|tests)/[\w./-]+\.\w+)`', text_of(document)):
            n += 1
            if target not in GENERATED and not os.path.exists(os.path.join(TOP, target)):
                complaints.append(f'{document}: there is no file "{target}"')
    print(f'{n} links in {len(documents())} documents')
    return complaints


def spelling():
    """codespell for known mistakes, hunspell with a list of our own words for unknown ones."""
    with tempfile.TemporaryDirectory() as folder:
        for document in documents():
            path = os.path.join(folder, document.lstrip('/'))
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, 'w', encoding='utf-8') as f:
                f.write(without_code(text_of(document)))
        run = subprocess.run(['codespell', '--ignore-words', os.path.join(TOP, 'tests', 'utilities', 'words.txt'), '.'], cwd=folder, stdout=subprocess.PIPE,
                             universal_newlines=True)
    complaints = run.stdout.splitlines()
    with tempfile.NamedTemporaryFile('w', suffix='.txt') as plain:
        for document in documents():
            text = re.sub(r'<!--.*?-->', '', without_code(text_of(document)), flags=re.DOTALL)
            text = re.sub(r'\]\([^)]*\)|https?://\S+|\S*[/_=\\]\S*|\S*\d\S*', ' ', text)
            # Headings of messages are what the program says.
            plain.write(re.sub(r"[’']s\b", '', re.sub(r'[^\w\s\'-]', ' ', text)) + '\n')
        plain.flush()
        run = subprocess.run(['hunspell', '-i', 'utf-8', '-d', 'en_GB,en_US', '-p', os.path.join(TOP, 'tests', 'utilities', 'words.txt'), '-l', plain.name],
                             stdout=subprocess.PIPE, universal_newlines=True, env=dict(os.environ, LC_ALL='C.UTF-8'))
    with open(os.path.join(TOP, 'tests', 'utilities', 'words.txt'), encoding='utf-8') as f:
        known = {line.strip() for line in f}
    known |= {w.lower() for w in known}
    unknown = sorted({w for w in run.stdout.split() if w not in known and w.lower() not in known and len(w) > 3 and w.isascii()})
    return complaints + [f'unknown word "{w}": mend it, or add it to tests/utilities/words.txt' for w in unknown]


def blocks(document):
    """(line, language, text, remark) of the code blocks."""
    result, remark, lines = [], '', text_of(document).split('\n')
    i = 0
    while i < len(lines):
        m = re.match(r'<!-- (not run|file|exit code): (.*) -->', lines[i])
        if m:
            remark = m.groups()
        elif lines[i].startswith('```') and lines[i] != '```':
            end = lines.index('```', i + 1)
            result.append((i + 1, lines[i][3:].strip(), '\n'.join(lines[i + 1:end]), remark))
            remark, i = '', end
        elif lines[i].strip():
            remark = ''
        i += 1
    return result


def copy_of_source(folder, program):
    for name in ('prm', 'contrib', 'doc'):
        shutil.copytree(os.path.join(TOP, name), os.path.join(folder, name), ignore=shutil.ignore_patterns('output*', '*.part-*'))
    os.makedirs(os.path.join(folder, 'build', 'release'))
    for name in ('signorini', 'signorini-map'):
        os.symlink(os.path.join(os.path.dirname(program), name), os.path.join(folder, 'build', 'release', name))


def declared_names(program):
    run = Program(program, 1).call('--print-parameters')
    return {(section.split(' ')[0], name) for section, name, _, _ in parameter_reference.declared(run.stdout)}


def run_document(document, program, names):
    complaints, counts = [], {'run': 0, 'not run': 0, 'prm': 0}
    found = [b for b in blocks(document) if b[1] in ('bash', 'prm')]
    if not found:
        return [], counts
    with tempfile.TemporaryDirectory() as folder:
        copy_of_source(folder, program)
        environment = dict(Program(program, 1).environment, PATH=os.path.dirname(program) + ':' + os.environ['PATH'], OMPI_MCA_odls_base_sigkill_timeout='0')
        environment.pop('OMPI_MCA_ess_singleton_isolated', None)
        where = folder
        for line, language, text, remark in found:
            place = f'{document}, line {line}'
            if language == 'prm':
                counts['prm'] += 1
                for section, name, _, _ in parameter_reference.declared(text):
                    if (section.split(' ')[0], name) not in names:
                        complaints.append(f'{place}: there is no parameter "{name}" in "{section}"')
                if remark and remark[0] == 'file':
                    with open(os.path.join(where, remark[1]), 'w') as f:
                        f.write(text + '\n')
                continue
            if remark and remark[0] == 'not run':
                counts['not run'] += 1
                continue
            counts['run'] += 1
            code = int(remark[1]) if remark and remark[0] == 'exit code' else 0
            # The folder in which a block ends is that of the next one.
            script = f'set -e\ntrap \'pwd > "{folder}/.where"\' EXIT\n{text}\n'
            run = subprocess.run(['bash', '-c', script], cwd=where, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
            with open(os.path.join(folder, '.where')) as f:
                where = f.read().strip()
            if run.returncode != code:
                complaints.append(f'{place}: exit code {run.returncode}\n{text}\n' + run.stdout.decode(errors='replace')[-1500:])
                # What follows builds on it.
                break
    return complaints, counts


def run_all(program, chosen):
    complaints, total = [], {'run': 0, 'not run': 0, 'prm': 0}
    names = declared_names(program)
    for document in chosen or documents():
        found, counts = run_document(document, program, names)
        complaints += found
        total = {key: total[key] + counts[key] for key in total}
    print(f'{total["run"]} blocks of commands run, {total["not run"]} marked as not to be run, {total["prm"]} blocks of parameters')
    return complaints


def reference(program):
    """Each declared parameter has its heading, a description and a default."""
    files = sorted(glob.glob(os.path.join(TOP, 'prm', '*', '*.prm')))
    page = subprocess.run(['/usr/bin/python3', os.path.join(TOP, 'contrib', 'utilities', 'parameter_reference.py'), program, *files], stdout=subprocess.PIPE,
                          universal_newlines=True, check=True).stdout
    entries = {m.group(1): m.group(2) for m in re.finditer(r'^### (.*)\n\n(.*)\n\n- default', page, re.MULTILINE)}
    complaints = []
    names = declared_names(program)
    for kind, name in names:
        if not entries.get(f'{kind}: {name}' if kind else name, '').strip():
            complaints.append(f'the reference has no description of "{kind}/{name}"')
    print(f'{len(names)} parameters, {page.count("- example")} with an example')
    return complaints


def main():
    what, rest = sys.argv[1], [os.path.abspath(a) if i == 0 else a for i, a in enumerate(sys.argv[2:])]
    complaints = {'links': links, 'spelling': spelling, 'parameters': lambda: reference(rest[0]), 'run': lambda: run_all(rest[0], rest[1:])}[what]()
    print('\n'.join(complaints))
    return bool(complaints)


if __name__ == '__main__':
    sys.exit(main())
