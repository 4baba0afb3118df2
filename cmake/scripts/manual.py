#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the manual page and the completions of bash, zsh and fish from the help of the program.

    cmake/scripts/manual.py majorant --man majorant.1.gz --bash majorant.bash --zsh _majorant --fish majorant.fish

`majorant --help` names the verbs, `majorant VERB --help` their options, so none can be missing. A line of
help that cannot be parsed is an error.
"""
import argparse
import gzip
import os
import re
import subprocess
from pathlib import Path

COLUMN = 28  # the column at which descriptions of options begin (apps/arguments/help_text.cpp)
DEFAULT_VERB = 'unwrap'  # the verb of a line with file names only
# words besides the verbs
WORDS = {'help': 'what a verb does, and its options', 'version': 'print the version'}
# tables below the options: the words that an option accepts
TABLES = {'--energy': 'Energies', '--methods': 'Methods'}


class Option:
    """A line `-o, --output FILE    description` of the help. choices: the words among its values, which may
    be others as well; takes_files: file names are values."""

    def __init__(self, usage, text, tables):
        self.text = text
        self.names, value = [], ''
        for word in usage.split(', '):
            name, _, value = word.partition(' ')
            self.names.append(name)
        self.value = value
        self.is_optional = value.startswith('[')
        values = (value[1:-1] if self.is_optional else value).split('|')
        self.takes_files = any(word.startswith('FILE') for word in values)
        self.choices = tables.get(TABLES.get(self.names[-1]), [])
        if len(values) > 1:
            self.choices = [word for value in values for word in self.words(value)]

    @staticmethod
    def words(value):
        """Returns the literal words of a value: `sharp` and `sharp=` for `sharp[=DEG]`, none for `N`."""
        word = re.match(r'[a-z0-9.-]*', value)[0]
        rest = value[len(word):]
        return [word] * (word != '' and rest[:1] != '=') + [word + '='] * (word != '' and '=' in rest)


class Help:
    """The parsed output of one --help: a summary, the usage, entries by section, and the last lines."""

    def __init__(self, text):
        blocks = text.rstrip('\n').split('\n\n')
        self.summary, self.usage = blocks[0], blocks[1].removeprefix('Usage: ')
        self.sections, self.footer, self.tables = {}, [], {}
        for block in blocks[2:]:
            heading, _, lines = block.partition('\n')
            if self.footer or heading == 'Examples:' or not re.fullmatch(r'[A-Z][a-z ]+:', heading):
                self.footer += ([''] if self.footer else []) + block.split('\n')
            else:
                self.sections[heading.rstrip(':')] = self.entries(lines.split('\n'))
        for line in self.footer:  # `Energies (...):`, followed by lines `  mips    description`
            table, entry = re.match(r'([A-Z][a-z]+)\b.*:$', line), re.match(r'  ([a-z-]+)  ', line)
            if table:
                names = self.tables.setdefault(table[1], [])
            elif entry and self.tables:
                names.append(entry[1])

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
        return [Option(usage, text, self.tables) for section, entries in self.sections.items() if section != 'Verbs'
                for usage, text in entries if usage.startswith('-')]

    def positionals(self):
        return [(usage, text) for usage, text in self.sections.get('Input and output', [])
                if not usage.startswith('-')]


def helps(program):
    def ask(*words):  # without line breaks
        return Help(subprocess.run([program, *words, '--help'], check=True, text=True, stdout=subprocess.PIPE,
                                   env=dict(os.environ, COLUMNS='10000')).stdout)
    top, verbs, groups = ask(), {}, {}
    for verb, _ in top.sections['Verbs']:
        text = ask(verb)
        inner = {'%s %s' % (verb, word): ask(verb, word) for word, _ in text.sections.get('Verbs', [])}
        verbs.update(inner or {verb: text})
        if inner:
            groups[verb] = text
    return top, verbs, groups


def groups_of(verbs):
    """Returns {'mesh': ['check', 'optimize']}: first words that are no verbs by themselves."""
    found = {}
    for verb in verbs:
        first, _, second = verb.partition(' ')
        if second:
            found.setdefault(first, []).append(second)
    return found


def first_words(verbs):
    return list(dict.fromkeys(verb.split()[0] for verb in verbs))


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


BASH = '''# bash completion for majorant; made by cmake/scripts/manual.py.
_majorant() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb k
  local -a said=()
  for ((k = 1; k < COMP_CWORD; ++k)); do
    [[ ${COMP_WORDS[k]} == -* ]] || said+=("${COMP_WORDS[k]}")
  done
  COMPREPLY=()
  verb=${said[0]}
  case "${said[*]}" in
    '') if [[ $word != -* ]]; then COMPREPLY=($(compgen -W '@VERBS@' -- "$word")); return; fi ;;
    help) COMPREPLY=($(compgen -W '@FIRST@' -- "$word")); return ;;
@GROUPS@
  esac
  case $verb in
@GROUPED@
  esac
  local options=
  case $verb in
    '') options='@TOP@' ;;
    help*|version) ;;
@OPTIONS@
  esac
  case "$verb$before" in
@CHOICES@
    *) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "$options" -- "$word")); fi ;;
  esac
}
complete -o bashdefault -o default -F _majorant majorant
'''

ZSH = '''#compdef majorant
# zsh completion for majorant; made by cmake/scripts/manual.py.
_majorant() {
  local -a verbs words_beside inner
  verbs=(
@VERBS@
  )
  words_beside=(
@WORDS@
  )
  if (( CURRENT == 2 )) && [[ $words[CURRENT] != -* ]]; then
    _describe verb verbs
    _describe word words_beside
    _files
    return
  fi
  local verb=$words[2]
  if [[ $verb == help ]]; then
    (( CURRENT == 3 )) && { _describe verb verbs; return }
    shift words; (( CURRENT-- ))
    verb=$words[2]
    case $verb in
@INNER@
    esac
    (( CURRENT == 3 )) && _describe verb inner
    return
  fi
  case $verb in
@INNER@
  esac
  if (( $#inner )); then
    if (( CURRENT == 3 )) && [[ $words[CURRENT] != -* ]]; then
      _describe verb inner
      return
    fi
    verb="$verb $words[3]"
    (( CURRENT > 3 )) && { shift words; (( CURRENT-- )) }
  fi
  shift words; (( CURRENT-- ))
  case $verb in
@CASES@
    -*) _arguments @TOP@ '*:file:_files' ;;
    version) ;;
    *) _arguments @DEFAULT@ '*:file:_files' ;;
  esac
}
_majorant "$@"
'''

FISH = '''# fish completion for majorant; made by cmake/scripts/manual.py.
# Succeeds if the words before the cursor that are no options begin with these; --only: are these.
function __majorant_said
    set -l said (commandline -opc | string match -rv '^-')
    set -e said[1]
    if set -q said[1]; and not contains -- $said[1] @WORDS@
        set said @DEFAULT@
    end
    if test "$argv[1]" = --only
        set -e argv[1]
    else if set -q argv[1]
        set said $said[1..(count $argv)]
    end
    test "$said" = "$argv"
end
'''


def names_of(text):
    return ' '.join(name for option in text.options() for name in option.names)


def bash_choices(option):
    reply = 'COMPREPLY=($(compgen -W %s%s -- "$word"))' % (shell_quoted(' '.join(option.choices)),
                                                          ' -f' if option.takes_files else '')
    if option.takes_files:
        reply += '; compopt -o filenames 2>/dev/null'
    if any(word.endswith('=') for word in option.choices):
        reply += '; [[ ${COMPREPLY[0]} != *= ]] || compopt -o nospace 2>/dev/null'
    return reply


def bash_completion(top, verbs, groups):
    choices = {}
    for verb, text in verbs.items():
        for option in text.options():
            if option.choices:
                for name in option.names:
                    choices.setdefault(bash_choices(option), []).append('"%s%s"' % (verb, name))
    inner = groups_of(verbs)
    return (BASH
            .replace('@VERBS@', ' '.join([*first_words(verbs), *WORDS]))
            .replace('@FIRST@', ' '.join(first_words(verbs)))
            .replace('@TOP@', names_of(top))
            .replace('@GROUPS@', '\n'.join(
                '    %s) if [[ $word != -* ]]; then COMPREPLY=($(compgen -W \'%s\' -- "$word")); return; fi ;;\n'
                '    "help %s") COMPREPLY=($(compgen -W \'%s\' -- "$word")); return ;;'
                % (group, ' '.join(seconds), group, ' '.join(seconds)) for group, seconds in inner.items()))
            .replace('@GROUPED@', '\n'.join('    %s) verb="%s${said[1]:+ ${said[1]}}" ;;' % (group, group)
                                            for group in inner)
                     + "\n    ''|help|version|%s) ;;\n    *) verb=%s ;;"
                     % ('|'.join(verb for verb in verbs if ' ' not in verb), DEFAULT_VERB))
            .replace('@OPTIONS@', '\n'.join('    "%s") options=\'%s\' ;;' % (verb, names_of(text))
                                            for verb, text in {**verbs, **groups}.items()))
            .replace('@CHOICES@', '\n'.join('    %s) %s ;;' % ('|'.join(keys), reply)
                                            for reply, keys in choices.items())))


def shell_quoted(text):
    return "'%s'" % text.replace("'", "'\\''")


def zsh_option(option):
    '''Returns specifications of _arguments, one per name; each may occur several times.'''
    text = re.sub(r'([\\\[\]:])', r'\\\1', option.text)
    value = ''
    if option.value:  # two colons begin an optional value
        what = '(%s)' % ' '.join(option.choices) if option.choices else '_files'
        if option.choices and option.takes_files:
            what = '_alternative "words:word:(%s)" "files:file:_files"' % ' '.join(option.choices)
            what = '{%s}' % what
        value = '%s%s:%s' % ('::' if option.is_optional else ':',
                             re.sub(r'[:\[\]|]', ' ', option.value).strip(), what)
    return [shell_quoted('*%s[%s]%s' % (name, text, value)) for name in option.names]


def zsh_completion(top, verbs, groups):
    def specifications(text):
        return ' \\\n      '.join(word for option in text.options() for word in zsh_option(option))

    def described(entries, indent):
        return '\n'.join(' ' * indent + shell_quoted('%s:%s' % (word, text.replace(':', r'\:')))
                         for word, text in entries)
    summaries = {**{verb: text.summary for verb, text in verbs.items() if ' ' not in verb},
                 **{group: text.summary for group, text in groups.items()}}
    inner = '\n'.join('      %s) inner=(\n%s\n      ) ;;'
                      % (group, described(((second, verbs['%s %s' % (group, second)].summary)
                                           for second in seconds), 8))
                      for group, seconds in groups_of(verbs).items())
    cases = ['    %s) _arguments %s \'*:file:_files\' ;;' % (shell_quoted(verb), specifications(text))
             for verb, text in verbs.items()]
    cases += ['    %s) _arguments %s ;;' % (shell_quoted(group + ' ') + '*', specifications(text))
              for group, text in groups.items()]
    return (ZSH
            .replace('@VERBS@', described(((word, summaries[word]) for word in first_words(verbs)), 4))
            .replace('@WORDS@', described(WORDS.items(), 4))
            .replace('@INNER@', inner)
            .replace('@CASES@', '\n'.join(cases))
            .replace('@TOP@', specifications(top))
            .replace('@DEFAULT@', specifications(verbs[DEFAULT_VERB])))


def fish_quoted(text):
    return "'%s'" % text.replace('\\', '\\\\').replace("'", "\\'")


def fish_line(condition, *words):
    return ' '.join(['complete -c majorant', '-n', fish_quoted(('__majorant_said ' + condition).strip()), *words])


def fish_option(condition, option):
    words = ['-l ' + name[2:] if name.startswith('--') else '-s ' + name[1:] for name in option.names]
    if option.choices:
        words.append('%s -a %s' % ('-r' if option.takes_files else '-x', fish_quoted(' '.join(option.choices))))
    elif option.value and not option.is_optional:
        words.append('-r')
    return fish_line(condition, *words, '-d', fish_quoted(option.text))


def fish_completion(top, verbs, groups):
    yield (FISH.replace('@WORDS@', ' '.join([*first_words(verbs), *WORDS])).replace('@DEFAULT@', DEFAULT_VERB)
           .rstrip('\n'))
    summaries = {verb: text.summary for verb, text in {**verbs, **groups}.items()}
    for word in first_words(verbs):
        for condition in '--only', '--only help':
            yield fish_line(condition, '-a', word, '-d', fish_quoted(summaries[word]))
    for word, text in WORDS.items():
        yield fish_line('--only', '-a', word, '-d', fish_quoted(text))
    for group, seconds in groups_of(verbs).items():
        for second in seconds:
            for condition in '--only ' + group, '--only help ' + group:
                yield fish_line(condition, '-a', second, '-d', fish_quoted(summaries['%s %s' % (group, second)]))
    for option in top.options():
        yield fish_option('--only', option)
    for group, text in groups.items():
        for option in text.options():
            yield fish_option('--only ' + group, option)
    for verb, text in verbs.items():
        for option in text.options():
            yield fish_option(verb, option)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('--man', type=Path, required=True)
    for shell in 'bash', 'zsh', 'fish':
        parser.add_argument('--' + shell, type=Path, required=True)
    arguments = parser.parse_args()
    top, verbs, groups = helps(arguments.program)
    version = subprocess.run([arguments.program, '--version'], check=True, text=True,
                             stdout=subprocess.PIPE).stdout.split()[1]
    page = '\n'.join(man_page(top, verbs, version)) + '\n'
    arguments.man.write_bytes(gzip.compress(page.encode(), 9, mtime=0))
    arguments.bash.write_text(bash_completion(top, verbs, groups))
    arguments.zsh.write_text(zsh_completion(top, verbs, groups))
    arguments.fish.write_text('\n'.join(fish_completion(top, verbs, groups)) + '\n')


if __name__ == '__main__':
    main()
