"""Reads tables such as src/def/keys.def: the rows ZP_KIND(...), with those that ZP_KEYS_OF_... stands for."""

import re


def arguments_of(inside):
    """The arguments of a macro, cut at commas outside of texts and parentheses."""
    return [text.strip() for text in re.split(r',(?=(?:[^"]*"[^"]*")*[^"]*$)(?![^()]*\))', inside)]


def rows(text):
    """(line number, kind, arguments as C texts) of each row. Texts beside each other are joined."""
    macros = {
        name: (parameters.split(", "), [line.strip(" \\") for line in body.splitlines()])
        for name, parameters, body in re.findall(r"^#define (ZP_\w+)\(([^).]*)\) (?:\\\n|(?=ZP_))((?:.*\\\n)*.*\n)", text, re.M)
    }

    def expand(line):
        found = re.fullmatch(r"ZP_(\w+)\((.*)\)", line)
        if not found:
            return
        if found.group(1) == "MANY":  # a group, and its rows
            yield from expand(found.group(2).split(", ", 1)[1])
            return
        given = arguments_of(found.group(2))
        if "ZP_" + found.group(1) not in macros:
            yield found.group(1), [re.sub(r'"\s+"', "", argument) for argument in given]
            return
        parameters, body = macros["ZP_" + found.group(1)]
        values = dict(zip(parameters, given))
        for row in body:
            yield from expand(re.sub(r'"[^"]*"|\w+', lambda word: values.get(word.group(), word.group()), row))

    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("ZP_"):
            for kind, given in expand(line):
                yield number, kind, given
