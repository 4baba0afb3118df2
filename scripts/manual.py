#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The manual page and the completions of bash, zsh and fish, from what the program says of itself.

    scripts/manual.py majorant --man majorant.1.gz --bash majorant.bash --zsh _majorant --fish majorant.fish

`majorant --help` names the verbs, `majorant VERB --help` their options: nothing is written down here, so
nothing can be missing. A line of help that is not understood is an error.
"""
import argparse
import gzip
import os
import re
import subprocess
from pathlib import Path

COLUMN = 28  # where what an option does begins (apps/arguments/help_text.cpp)


class Option:
    """One line `-o, --output FILE    what it does` of help."""

    def __init__(self, usage, text):
        self.text = text
        self.names, value = [], ''
        for word in usage.split(', '):
            name, _, value = word.partition(' ')
            self.names.append(name)
        self.value = value
        self.choices = value.strip('[]').split('|') if '|' in value else []


class Help:
    """What one --help prints: a line about it, how it is called, entries by section, and what comes last."""

    def __init__(self, text):
        blocks = text.rstrip('\n').split('\n\n')
        self.summary, self.usage = blocks[0], blocks[1].removeprefix('Usage: ')
        self.sections, self.footer = {}, []
        for block in blocks[2:]:
            heading, _, lines = block.partition('\n')
            if self.footer or heading == 'Examples:' or not re.fullmatch(r'[A-Z][a-z ]+:', heading):
                self.footer += ([''] if self.footer else []) + block.split('\n')
            else:
                self.sections[heading.rstrip(':')] = self.entries(lines.split('\n'))

    @staticmethod
    def entries(lines):
        found = []
        for line in lines:
            if line.startswith(' ' * COLUMN):  # the text of a usage that fills its column
                found[-1][1] = line.strip()
            elif re.match(r'  \S', line):
                found.append([line[:COLUMN].strip(), line[COLUMN:].strip()] if line[COLUMN - 2:COLUMN] == '  '
                             else [line.strip(), ''])
            else:
                raise SystemExit('manual.py: this line of help is not understood: ' + line)
        return found

    def options(self):
        return [Option(usage, text) for section, entries in self.sections.items() if section != 'Verbs'
                for usage, text in entries if usage.startswith('-')]

    def positionals(self):
        return [(usage, text) for usage, text in self.sections.get('Input and output', [])
                if not usage.startswith('-')]


def helps(program):
    def ask(*words):  # on lines as long as they are
        return Help(subprocess.run([program, *words, '--help'], check=True, text=True, stdout=subprocess.PIPE,
                                   env=dict(os.environ, COLUMNS='10000')).stdout)
    top, verbs = ask(), {}
    for verb, _ in top.sections['Verbs']:
        text = ask(verb)
        inner = {'%s %s' % (verb, word): ask(verb, word) for word, _ in text.sections.get('Verbs', [])}
        verbs.update(inner or {verb: text})
    return top, verbs


class Merged:
    """What completions offer behind a first word: the verbs behind it, and the options of all of them."""

    def __init__(self, words, texts):
        self.words, self.summary = words, texts[0].summary
        self._options = {tuple(option.names): option for text in texts for option in text.options()}

    def options(self):
        return list(self._options.values())


def by_first_word(verbs):
    found = {}
    for verb, text in verbs.items():
        first, _, rest = verb.partition(' ')
        found.setdefault(first, []).append((rest, text))
    return {first: Merged([rest for rest, _ in inner if rest], [text for _, text in inner])
            for first, inner in found.items()}


def roff(text):
    text = text.replace('\\', '\\e').replace('-', '\\-')
    return re.sub(r"^([.'])", r'\\&\1', text, flags=re.M)


def man_options(options):
    for option in options:
        names = ', '.join('\\fB%s\\fR' % roff(name) for name in option.names)
        value = ' \\fI%s\\fR' % roff(option.value) if option.value else ''
        yield '.TP\n%s%s\n%s' % (names, value, roff(option.text))


def man_page(top, verbs, version):
    name, _, summary = top.summary.partition(': ')
    yield '.TH MAJORANT 1 "" "majorant %s" "User Commands"' % roff(version)
    yield '.SH NAME\n%s \\- %s' % (name, roff(summary))
    yield '.SH SYNOPSIS'
    for verb, text in verbs.items():
        words = re.sub(r'\w+', r'\\fI\g<0>\\fR', text.usage.split(verb + ' ', 1)[1])
        yield '.B majorant %s\n%s\n.br' % (verb, words)
    yield '.B majorant\n\\fIinput output\\fR\n.SH DESCRIPTION'
    yield roff('Without a verb it is unwrap that is meant.')
    for verb, text in verbs.items():
        yield '.SS "majorant %s"\n%s' % (verb, roff(text.summary))
        for usage, meaning in text.positionals():
            yield '.TP\n\\fI%s\\fR\n%s' % (usage, roff(meaning))
        yield from man_options(text.options())
        yield '.PP\n.nf\n%s\n.fi' % roff('\n'.join(text.footer))
    yield '.SH OPTIONS'
    yield from man_options(top.options())
    codes = ' '.join(line.strip() for line in top.footer).partition('Exit codes: ')[2]
    yield '.SH EXIT STATUS'
    for code in codes.rstrip('.').split(', '):
        number, _, meaning = code.partition(' ')
        yield '.TP\n%s\n%s' % (number, roff(meaning))


BASH = '''# bash completion for majorant; made by scripts/manual.py.
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

ZSH = '''#compdef majorant
# zsh completion for majorant; made by scripts/manual.py.
_majorant() {
  local -a verbs
  verbs=(
@VERBS@
  )
  if (( CURRENT == 2 )) && [[ $words[CURRENT] != -* ]]; then
    _describe verb verbs
    _files
    return
  fi
  case $words[2] in
@CASES@
    *) _arguments @TOP@ '*:file:_files' ;;
  esac
}
_majorant "$@"
'''


def names_of(text):
    return ' '.join(getattr(text, 'words', []) + [name for option in text.options() for name in option.names])


def bash_completion(top, verbs):
    choices = {}
    for verb, text in verbs.items():
        for option in text.options():
            if option.choices:
                for name in option.names:
                    choices.setdefault((name, ' '.join(option.choices)), []).append(verb + name)
    return (BASH
            .replace('@TOP@', names_of(top)).replace('@VERBS@', ' '.join(verbs))
            .replace('@OPTIONS@', '\n'.join("    %s) options='%s' ;;" % (verb, names_of(text))
                                            for verb, text in verbs.items()))
            .replace('@CHOICES@', '\n'.join("    %s) COMPREPLY=($(compgen -W '%s' -- \"$word\")) ;;"
                                            % ('|'.join(keys), words)
                                            for (_, words), keys in choices.items())))


def shell_quoted(text):
    return "'%s'" % text.replace("'", "'\\''")


def zsh_option(option):
    '''Specifications of _arguments, one a name: any of them may come several times.'''
    text = re.sub(r'([\\\[\]:])', r'\\\1', option.text)
    value = ''
    if option.value:  # one that may be left out begins with two colons
        what = '(%s)' % ' '.join(option.choices) if option.choices else '_files'
        value = '%s%s:%s' % ('::' if option.value.startswith('[') else ':',
                             re.sub(r'[:\[\]|]', ' ', option.value).strip(), what)
    return [shell_quoted('*%s[%s]%s' % (name, text, value)) for name in option.names]


def zsh_completion(top, verbs):
    def specifications(text):
        return ' \\\n      '.join(word for option in text.options() for word in zsh_option(option))
    return (ZSH
            .replace('@VERBS@', '\n'.join('    ' + shell_quoted('%s:%s' % (verb, text.summary.replace(':', r'\:')))
                                          for verb, text in verbs.items()))
            .replace('@CASES@', '\n'.join("    %s) shift words; (( CURRENT-- ))\n      _arguments %s '*:file:_files' ;;"
                                          % (verb, specifications(text)) for verb, text in verbs.items()))
            .replace('@TOP@', specifications(top)))


def fish_quoted(text):
    return "'%s'" % text.replace('\\', '\\\\').replace("'", "\\'")


def fish_option(condition, option):
    words = ['complete -c majorant', condition]
    for name in option.names:
        words.append('-l ' + name[2:] if name.startswith('--') else '-s ' + name[1:])
    if option.choices:
        words.append('-x -a ' + fish_quoted(' '.join(option.choices)))
    elif option.value and not option.value.startswith('['):
        words.append('-r')
    return ' '.join(words + ['-d', fish_quoted(option.text)])


def fish_completion(top, verbs):
    yield '# fish completion for majorant; made by scripts/manual.py.'
    none = "-n '__fish_use_subcommand'"
    for verb, text in verbs.items():
        yield 'complete -c majorant %s -a %s -d %s' % (none, verb, fish_quoted(text.summary))
    for option in top.options():
        yield fish_option(none, option)
    for verb, text in verbs.items():
        for option in text.options():
            yield fish_option("-n '__fish_seen_subcommand_from %s'" % verb, option)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('--man', type=Path, required=True)
    for shell in 'bash', 'zsh', 'fish':
        parser.add_argument('--' + shell, type=Path, required=True)
    arguments = parser.parse_args()
    top, verbs = helps(arguments.program)
    version = subprocess.run([arguments.program, '--version'], check=True, text=True,
                             stdout=subprocess.PIPE).stdout.split()[1]
    page = '\n'.join(man_page(top, verbs, version)) + '\n'
    arguments.man.write_bytes(gzip.compress(page.encode(), 9, mtime=0))
    verbs = by_first_word(verbs)
    arguments.bash.write_text(bash_completion(top, verbs))
    arguments.zsh.write_text(zsh_completion(top, verbs))
    arguments.fish.write_text('\n'.join(fish_completion(top, verbs)) + '\n')


if __name__ == '__main__':
    main()
