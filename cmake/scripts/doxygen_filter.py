#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a header for doxygen, with its plain // comments as documentation.

    cmake/scripts/doxygen_filter.py HEADER > FILTERED

A comment before #pragma once documents the file and the class with the file's name; other types without a
comment refer to it. A comment above a declaration, or after it on its line, documents the declaration. Lines
indented by three spaces (code) or five (formulas, lists) become code blocks.
"""
import pathlib
import re
import sys

COMMENT = re.compile(r'^( *)//( *)(.*)$')
BEHIND = re.compile(r'^(.*[;,{}(] *)// (.*)$')
TYPE = re.compile(r'^(?:class|struct|enum class) (\w+)[^;]*$')
SPECIAL = re.compile(r'([<>@\\#&])')  # special characters of doxygen


def text_of(text, is_code):
    return '    ' + text if is_code else SPECIAL.sub(r'\\\1', text)


def filtered(lines, stem):
    yield '/// @file'
    is_behind = is_documented = False
    for line in lines:
        if line.startswith('// SPDX-'):
            continue
        comment, behind, kind = COMMENT.match(line), BEHIND.match(line), TYPE.match(line)
        if comment:
            indent, gap, text = comment.groups()
            opening = '///<' if is_behind and len(indent) > 30 else '///'
            yield '%s%s %s' % (indent, opening, text_of(text, len(gap) >= 3 and bool(text)))
            is_documented = True
            continue
        if kind and not is_documented:
            same = kind[1].lower() == stem.replace('_', '')
            yield ('/// @copydoc %s.h' if same else '/// See the head of %s.h.') % stem
        is_behind, is_documented = bool(behind), line.startswith('template')
        yield '%s///< %s' % (behind[1], text_of(behind[2], False)) if is_behind else line


def main():
    path = pathlib.Path(sys.argv[1])
    print('\n'.join(filtered(path.read_text().splitlines(), path.stem)))


if __name__ == '__main__':
    main()
