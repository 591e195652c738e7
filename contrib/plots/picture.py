# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""What the tools that draw share: where a picture goes, and reading the results."""
import csv
import json
import os
import re
import struct
import sys

import numpy as np

MARK = 'Software'


def fail(tool, text):
    sys.exit(f'{tool}: {text}')


def drawn_by(path):
    """The tool that a picture names, or None: the text chunks of a PNG file."""
    with open(path, 'rb') as f:
        if f.read(8) != b'\x89PNG\r\n\x1a\n':
            return None
        while True:
            head = f.read(8)
            if len(head) < 8:
                return None
            length, kind = struct.unpack('>I4s', head)
            if kind == b'IDAT':
                return None
            data = f.read(length)
            f.read(4)
            if kind == b'tEXt' and data.startswith(MARK.encode() + b'\0'):
                return data[len(MARK) + 1:].decode('latin-1')


def place(folder, name, tool):
    """Where a picture goes: NAME.png; NAME-2.png and so on where a file lies that this tool has not drawn."""
    number = 1
    while True:
        path = os.path.join(folder, f'{name}.png' if number == 1 else f'{name}-{number}.png')
        if not os.path.lexists(path) or (os.path.isfile(path) and not os.path.islink(path) and drawn_by(path) == mark(tool)):
            return path
        number += 1


def mark(tool):
    return f'signorini {tool}'


def save(figure, folder, name, tool, dpi=130):
    """Writes a picture as large as all that is drawn in it, legends and titles included, and says where it is."""
    path = place(folder, name, tool)
    try:
        figure.savefig(path, dpi=dpi, bbox_inches='tight', pad_inches=.12, facecolor='white', metadata={MARK: mark(tool)})
    except OSError as error:
        fail(tool, f'"{path}" cannot be written: {error.strerror}')
    print(path)
    return path


def read_summary(folder, tool):
    path = os.path.join(folder, 'summary.json')
    try:
        with open(path) as f:
            return json.load(f)
    except OSError as error:
        fail(tool, f'"{path}" cannot be read: {error.strerror}. Is it the folder of a run?')
    except ValueError:
        fail(tool, f'"{path}" is damaged.')


def read_pressure(folder, tool, side='nonmortar'):
    """pressure.csv: arrays by column, of the nodes on one side."""
    path = os.path.join(folder, 'pressure.csv')
    try:
        with open(path, newline='') as f:
            rows = [row for row in csv.DictReader(f) if row['side'] == side]
    except OSError as error:
        fail(tool, f'"{path}" cannot be read: {error.strerror}. Is it the folder of a run?')
    except KeyError as error:
        fail(tool, f'"{path}" has no column {error}.')
    if not rows:
        return {}
    return {name: np.array([row[name] for row in rows]) if name in ('side', 'pair') else np.array([float(row[name]) for row in rows])
            for name in rows[0]}


def command_line():
    """The arguments with those that are lists of numbers and begin with a minus sign joined to their options."""
    words = []
    for word in sys.argv[1:]:
        if re.match(r'-[\d.]+(e[-+]?\d+)?,', word) and words and words[-1].startswith('--'):
            words[-1] += '=' + word
        else:
            words.append(word)
    return words


def number(value):
    return f'{value:.4g}'
