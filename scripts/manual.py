#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The manual page and the completion of bash, from what the program says of itself.

    scripts/manual.py majorant --man majorant.1.gz --completion majorant.bash

`majorant --help` names the verbs, `majorant VERB --help` their options: nothing is written down here, so
nothing can be missing. A line of help that is not understood is an error.
"""
import argparse
import gzip
import re
import subprocess
from pathlib import Path

ENTRY = re.compile(r'  (\S.*?)(?:\s{2,}(\S.*))?$')
CHOICES = re.compile(r'\{([^}]*)\}')


class Option:
    """One line `-o,--output TEXT ...   what it does` of help."""

    def __init__(self, usage, text):
        names, _, rest = usage.partition(' ')
        self.names, self.text = names.split(','), text
        rest = re.sub(r'\s*(Excludes|Needs):.*', '', rest)
        self.choices = CHOICES.search(rest)[1].split(',') if CHOICES.search(rest) else []
        value = re.sub(r':(INT|FLOAT|FILE|TEXT)?( in )?.*', '', rest).replace('REQUIRED', '').strip()
        self.value = '|'.join(self.choices) or re.sub(r'=.*', '', value)
        limits = re.search(r'in \[(\S+) - (\S+)\]', rest)
        self.limits = ' (%s to %s)' % limits.groups() if limits else ''


class Help:
    """What one --help prints: a line about it, entries by section, and what comes last."""

    def __init__(self, text):
        lines = text.splitlines()
        self.summary, self.sections, self.footer = lines[0], {}, []
        entries, paragraph = None, []
        for line in lines[2:]:
            heading = re.fullmatch(r'(Positionals|Options|Subcommands):', line)
            if heading and not self.footer:
                entries = self.sections.setdefault(heading[1], [])
            elif not line:
                entries = None
            elif entries is None:
                self.footer.append(line)
            elif line.startswith(' ' * 20):
                entries[-1][1] = (entries[-1][1] or '') + line.strip()
            else:
                entries.append(self.entry(line))

    @staticmethod
    def entry(line):
        # Where the usage is long, one blank is all that stands between it and the text.
        if len(line) > 29 and line[29] == ' ' and line[30:31] not in ('', ' ') and '  ' not in line[2:]:
            return [line[2:29].strip(), line[30:]]
        found = ENTRY.fullmatch(line)
        if not found:
            raise SystemExit('manual.py: this line of help is not understood: ' + line)
        if found[2] is None and len(line) > 29:  # text at its column, one blank before
            return [line[2:29].strip(), line[30:].strip()] if line[29] == ' ' else [line.strip(), '']
        return [found[1], found[2] or '']

    def options(self):
        return [Option(usage, text) for usage, text in self.sections.get('Options', [])]

    def words(self, section):
        return [(usage.split()[0], text) for usage, text in self.sections.get(section, [])]


def helps(program):
    def ask(*words):
        return Help(subprocess.run([program, *words, '--help'], check=True, text=True,
                                   stdout=subprocess.PIPE).stdout)
    top = ask()
    return top, {verb: ask(verb) for verb, _ in top.words('Subcommands')}


def roff(text):
    text = text.replace('\\', '\\e').replace('-', '\\-')
    return re.sub(r"^([.'])", r'\\&\1', text, flags=re.M)


def man_options(options):
    for option in options:
        names = ', '.join('\\fB%s\\fR' % roff(name) for name in option.names)
        value = ' \\fI%s\\fR' % roff(option.value) if option.value else ''
        yield '.TP\n%s%s\n%s' % (names, value, roff(option.text + option.limits))


def man_page(top, verbs, version):
    name, _, summary = top.summary.partition(': ')
    yield '.TH MAJORANT 1 "" "majorant %s" "User Commands"' % roff(version)
    yield '.SH NAME\n%s \\- %s' % (name, roff(summary))
    yield '.SH SYNOPSIS'
    for verb, text in verbs.items():
        words = ' '.join('[\\fI%s\\fR]' % word if 'REQUIRED' not in usage else '\\fI%s\\fR' % word
                         for usage, _ in text.sections['Positionals'] for word in [usage.split()[0]])
        yield '.B majorant %s\n%s [\\fIOPTIONS\\fR]\n.br' % (verb, words)
    yield '.B majorant\n\\fIinput output\\fR\n.SH DESCRIPTION'
    yield roff('Without a verb it is unwrap that is meant.')
    for verb, text in verbs.items():
        yield '.SS "majorant %s"\n%s' % (verb, roff(text.summary))
        for usage, meaning in text.sections['Positionals']:
            yield '.TP\n\\fI%s\\fR\n%s' % (usage.split()[0], roff(meaning))
        yield from man_options(text.options())
        yield '.PP\n.nf\n%s\n.fi' % roff('\n'.join(text.footer))
    yield '.SH OPTIONS'
    yield from man_options(top.options())
    codes = ' '.join(line.strip() for line in top.footer).partition('Exit codes: ')[2]
    yield '.SH EXIT STATUS'
    for code in codes.rstrip('.').split(', '):
        number, _, meaning = code.partition(' ')
        yield '.TP\n%s\n%s' % (number, roff(meaning))


COMPLETION = '''# bash completion for majorant; made by scripts/manual.py.
_majorant() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb= k
  for ((k = 1; k < COMP_CWORD; ++k)); do
    case ${COMP_WORDS[k]} in -*) ;; *) verb=${COMP_WORDS[k]}; break ;; esac
  done
  COMPREPLY=()
  local options=
  case $verb in
    '') [[ $word == -* ]] && options='@TOP@' || options='@VERBS@' ;;
@OPTIONS@
  esac
  case $verb$before in
@CHOICES@
    *) if [[ -z $verb || $word == -* ]]; then COMPREPLY=($(compgen -W "$options" -- "$word")); fi ;;
  esac
}
complete -o bashdefault -o default -F _majorant majorant
'''


def completion(top, verbs):
    def names(text):
        return ' '.join(name for option in text.options() for name in option.names)
    choices = {}
    for verb, text in verbs.items():
        for option in text.options():
            if option.choices:
                for name in option.names:
                    choices.setdefault((name, ' '.join(option.choices)), []).append(verb + name)
    return (COMPLETION
            .replace('@TOP@', names(top)).replace('@VERBS@', ' '.join(verbs))
            .replace('@OPTIONS@', '\n'.join("    %s) options='%s' ;;" % (verb, names(text))
                                            for verb, text in verbs.items()))
            .replace('@CHOICES@', '\n'.join("    %s) COMPREPLY=($(compgen -W '%s' -- \"$word\")) ;;"
                                            % ('|'.join(keys), words)
                                            for (_, words), keys in choices.items())))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('--man', type=Path, required=True)
    parser.add_argument('--completion', type=Path, required=True)
    arguments = parser.parse_args()
    top, verbs = helps(arguments.program)
    version = subprocess.run([arguments.program, '--version'], check=True, text=True,
                             stdout=subprocess.PIPE).stdout.split()[1]
    page = '\n'.join(man_page(top, verbs, version)) + '\n'
    arguments.man.write_bytes(gzip.compress(page.encode(), 9, mtime=0))
    arguments.completion.write_text(completion(top, verbs))


if __name__ == '__main__':
    main()
