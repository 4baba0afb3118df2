#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""report_table.py [--write]: makes the tables of docs/interface.md on reports from
apps/jobs/report.schema.json.

Prints the text between the two marks of the page; --write inserts it. A part of the schema with a title has
its own table; other parts are described in place.
"""
import json
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(ROOT, 'docs', 'interface.md')
MARKS = '<!-- made by cmake/scripts/report_table.py --write -->\n', '<!-- end of what it makes -->\n'
WORDS = {'string': 'text', 'boolean': 'true or false', 'array': 'list'}

with open(os.path.join(ROOT, 'apps/jobs', 'report.schema.json')) as file:
    SCHEMA = json.load(file)


def target(rule):
    return SCHEMA['$defs'][rule['$ref'].split('/')[-1]] if '$ref' in rule else None


def link(part):
    title = part['title']
    return '[%s](#%s)' % (title, re.sub(r'[^\w -]', '', title).lower().replace(' ', '-'))


def type_of(rule):
    if 'anyOf' in rule:
        return '%s, or null' % type_of(rule['anyOf'][0])
    part = target(rule)
    if part:
        may_be_null = 'null' in part.get('type', '')
        return link(part) + (', or null' if may_be_null else '') if 'title' in part else type_of(part)
    if 'const' in rule:
        return json.dumps(rule['const'])
    if 'enum' in rule:
        return ', '.join('null' if word is None else '`%s`' % word for word in rule['enum'])
    names = rule.get('type', 'object')
    names = [WORDS.get(name, name) for name in ([names] if isinstance(names, str) else names)]
    if names[0] == 'list':
        inner = rule['items']
        of = target(inner) or {}
        names[0] = 'list of %s' % (link(of) if 'title' in of else type_of(inner).replace('list', 'lists'))
    return ' or '.join(names)


def rows(rule, prefix='', is_optional=False):
    """Yields the lines of a table: keys of a rule, and those that it takes from other rules."""
    part = target(rule)
    required = rule.get('required', []) + (SCHEMA['required'] if not prefix else [])
    if part is not None:
        if 'title' in part:
            yield '| `%s*`%s | %s | |' % (prefix, ' *' if is_optional else '', link(part))
        else:
            yield from rows(part, prefix, is_optional)
    for inner in rule.get('allOf', []):
        yield from rows(inner, prefix, is_optional)
    for key, inner in rule.get('properties', {}).items():
        star = ' *' if is_optional or key not in required else ''
        yield from key_rows(prefix + key, inner, star)
    for branch in ('then', 'else'):
        if prefix and branch in rule:
            yield from rows(rule[branch], prefix, True)


def key_rows(key, rule, star):
    part = rule.get('anyOf', [rule])[0]
    of = target(part) or part
    text = rule.get('description', of.get('description', ''))
    is_linked = target(part) is not None and 'title' in of
    is_plain = is_linked or not any(word in of for word in ('properties', 'additionalProperties', 'then', 'allOf'))
    is_map = isinstance(of.get('additionalProperties'), dict)
    if is_plain or star or is_map or 'anyOf' in rule or 'null' in of.get('type', ''):
        yield '| `%s`%s | %s | %s |' % (key, star, type_of(rule), text.replace('|', '\\|'))
    if is_linked:
        return
    if is_map:
        yield from key_rows(key + '.NAME', of['additionalProperties'], star)
    elif not is_plain:
        yield from rows(of, key + '.', bool(star))
    items = of.get('items', {})
    inner = target(items) or items
    if 'properties' in inner and 'title' not in inner:
        yield from rows(inner, key + '[].', bool(star))


def table(part):
    lines = ['### ' + part['title'], '', '| key | is | meaning |', '|---|---|---|']
    lines += [re.sub(r' +\|', ' |', line) for line in rows(part)]
    return '\n'.join(lines) + '\n'


def tables():
    root = {key: SCHEMA[key] for key in ('title', 'required', 'properties')}
    return '\n'.join([table(root)] + [table(part) for part in SCHEMA['$defs'].values() if 'title' in part])


def page():
    """Returns the current page and the expected one."""
    with open(PAGE) as f:
        text = f.read()
    before, rest = text.split(MARKS[0])
    return text, before + MARKS[0] + '\n' + tables() + '\n' + MARKS[1] + rest.split(MARKS[1])[1]


if __name__ == '__main__':
    if sys.argv[1:] == ['--write']:
        made = page()[1]
        with open(PAGE, 'w') as f:
            f.write(made)
    else:
        print(tables(), end='')
