# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Judges reports by apps/jobs/report.schema.json, for the tests; knows only the keywords that the schema uses.

    faults, seen = validated(report)   # seen: JSON pointers of the schema's keys that the report has
"""
import json
import os
import re

with open(os.path.join(os.environ.get('MAJORANT_SOURCE_DIR', ''), 'apps/jobs', 'report.schema.json')) as file:
    SCHEMA = json.load(file)
TYPES = {'object': dict, 'array': list, 'string': str, 'integer': int, 'number': (int, float), 'boolean': bool,
         'null': type(None)}
PASSIVE = {'$schema', '$defs', 'title', 'description', 'then', 'else', 'additionalProperties', 'unevaluatedProperties'}


def validated(report):
    faults, _, seen = judge(report, SCHEMA, '#', 'report')
    return faults, seen


def judge(value, rule, at, path):
    """Returns faults, keys of `value` that the rule knows, and pointers of these. at: pointer of the rule; path: of
    the value."""
    faults, known, seen, fields = [], set(), set(), value if isinstance(value, dict) else {}

    def apply(inner, where, part=value, key=''):
        more, keys, pointers = judge(part, inner, where, path + key)
        faults.extend(more)
        seen.update(pointers)
        known.update(keys if not key else ())

    def demand(holds, words):
        if not holds:
            faults.append('%s: %s' % (path, words))

    for word, of in rule.items():
        if word == '$ref':
            apply(SCHEMA['$defs'][of.split('/')[-1]], of)
        elif word == 'type':
            names = of if isinstance(of, list) else [of]
            demand(any(isinstance(value, TYPES[name]) and (name == 'boolean' or not isinstance(value, bool))
                       for name in names), '%r is no %s' % (value, names))
        elif word in ('enum', 'const'):
            demand(value in (of if word == 'enum' else [of]), '%r is not %r' % (value, of))
        elif word == 'allOf':
            for k, inner in enumerate(of):
                apply(inner, '%s/allOf/%d' % (at, k))
        elif word == 'anyOf':
            fits = [not judge(value, inner, at, path)[0] for inner in of]
            k = fits.index(True) if any(fits) else 0
            apply(of[k], '%s/anyOf/%d' % (at, k))
        elif word == 'if':
            branch = 'else' if judge(value, of, at, path)[0] else 'then'
            apply(rule.get(branch, {}), '%s/%s' % (at, branch))
        elif word == 'items':
            for k, part in enumerate(value if isinstance(value, list) else ()):
                apply(of, at + '/items', part, '[%d]' % k)
        elif word in ('minItems', 'maxItems'):  # the schema only uses both together
            demand(not isinstance(value, list) or len(value) == of, 'not %r elements' % of)
        elif word == 'required':
            demand(not isinstance(value, dict) or set(of) <= set(fields), 'lacks %s' % sorted(set(of) - set(fields)))
        elif word == 'maxProperties':
            demand(len(fields) <= of, 'more than %d keys' % of)
        elif word == 'propertyNames':
            demand(all(re.search(of['pattern'], key) for key in fields), 'keys are not %s' % of['pattern'])
        elif word == 'properties':
            for key in set(of) & set(fields):
                seen.add('%s/properties/%s' % (at, key))
                apply(of[key], '%s/properties/%s' % (at, key), fields[key], '.' + key)
            known.update(of)
        else:
            assert word in PASSIVE, 'tests/apps/report_schema.py does not know ' + word
    rest = rule.get('additionalProperties', rule.get('unevaluatedProperties'))
    for key in set(fields) - known if rest is not None else ():
        demand(rest, 'the schema lacks ' + key)
        apply(rest or {}, at + '/additionalProperties', fields[key], '.' + key)
    return faults, known, seen


def keys_of(rule, at='#'):
    """Returns pointers of all keys of reports in the schema, except those of conditions."""
    for word, inner in rule.items() if isinstance(rule, dict) else enumerate(rule):
        if word != 'if':
            if isinstance(inner, (dict, list)):
                yield from keys_of(inner, '%s/%s' % (at, word))
            if at.endswith('/properties'):
                yield '%s/%s' % (at, word)
