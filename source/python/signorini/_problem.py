# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Signorini authors
"""Problems as dictionaries: from them the text of a parameter file, and back from its lines to the places in the dictionary."""
import math
import numbers
import os
import re
from collections.abc import Mapping

import numpy as np

from ._core import InputError

NAME = 'problem'


def word(value, where):
    """A single value as a parameter file has it; None is a free component."""
    if value is None:
        return '*'
    if isinstance(value, (bool, np.bool_)):
        return 'true' if value else 'false'
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        if not math.isfinite(value):
            raise InputError(f'{where}: {value} is no number to compute with.')
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        text = os.fspath(value)
        if re.search(r'[\n\r#]|\\$', text):
            raise InputError(f'{where}: a text must not have line breaks, "#", or a backslash at its end.')
        return text
    raise InputError(f'{where}: a {type(value).__name__} is no value of a parameter; there are numbers, texts, true and false, '
                     'sequences of them, and dictionaries of names.')


def value_text(value, where):
    """A value: (1, 2, 3) is "1, 2, 3"; {"top": (0, None, -1)} is "top: (0, *, -1)"."""
    if value is None:
        return ''
    if isinstance(value, Mapping):
        return '; '.join(f'{name}: {entry_text(entry, f"{where}, {name}")}' for name, entry in value.items())
    if isinstance(value, (list, tuple, np.ndarray)):
        return ', '.join(word(item, where) for item in value)
    return word(value, where)


def entry_text(value, where):
    """The value of a name: sequences in brackets."""
    return f'({value_text(value, where)})' if isinstance(value, (list, tuple, np.ndarray)) else word(value, where)


def sections_of(problem):
    """(section or None, name, value) of all parameters. "Bodies" and "Contact pairs" may hold the sections of bodies and pairs
    themselves; where they are missing they are the names of the sections."""
    listed = {}
    for list_name, kind in (('Bodies', 'Body '), ('Contact pairs', 'Pair ')):
        given = problem.get(list_name)
        if isinstance(given, Mapping):
            listed[list_name] = [(kind + name, section) for name, section in given.items()]
        elif given is None:
            listed[list_name] = [(name, section) for name, section in problem.items() if name.startswith(kind)]
        else:
            yield None, list_name, given
            continue
        yield None, list_name, ', '.join(section[len(kind):] for section, _ in listed[list_name])
    expanded = [item for name in listed if isinstance(problem.get(name), Mapping) for item in listed[name]]
    rest = [(name, value) for name, value in problem.items() if name not in ('Bodies', 'Contact pairs')]
    for name, value in expanded + rest:
        if isinstance(value, Mapping):
            for parameter, entry in value.items():
                yield name, parameter, entry
        else:
            yield None, name, value


def place(section, name):
    return f'{section}/{name}' if section else name


def parameter_text(problem):
    """The lines of a parameter file, and for each of them the place that it comes from."""
    lines, places = [], []
    for section, name, value in sections_of(problem):
        where = place(section, name)
        setting = f'set {name} = {value_text(value, where)}'
        block = [f'subsection {section}', setting, 'end'] if section else [setting]
        lines += block
        places += [where] * len(block)
    return '\n'.join(lines) + '\n', places


def override_list(overrides):
    """["Section/Name=value", ...] from a nested dictionary."""
    result = []
    for name, value in (overrides or {}).items():
        for parameter, entry in (value.items() if isinstance(value, Mapping) else [(None, value)]):
            where = name if parameter is None else f'{name}/{parameter}'
            result.append(f'{where}={value_text(entry, where)}')
    return result


def explain(message, places, name=NAME):
    """A message about a line of a text, with the place in the dictionary instead."""
    def at(match):
        number = int(match.group(1))
        return places[number - 1] if 1 <= number <= len(places) else name
    return re.sub(rf'[Ll]ine <(\d+)> of file <{name}>', at, message)
