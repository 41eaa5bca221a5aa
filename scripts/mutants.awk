# Lists the small changes (mutants) that scripts/mutate.sh tries on C++ files, one per line, separated by tabs: file,
# line, column, length of the replaced text, new text. Works on tokens and relies on clang-format, which puts spaces
# around binary operators only.

BEGIN {
    OFS = "\t"
    swap_operator("[+]", "-"); swap_operator("-", "+"); swap_operator("[*]", "/"); swap_operator("/", "*")
    swap_operator("[+]=", "-="); swap_operator("-=", "+="); swap_operator("[*]=", "/="); swap_operator("[|]=", "\\&=")
    swap_operator("<", "<="); swap_operator("<", ">"); swap_operator("<=", "<"); swap_operator("<=", ">=")
    swap_operator(">", ">="); swap_operator(">", "<"); swap_operator(">=", ">"); swap_operator(">=", "<=")
    swap_operator("==", "!="); swap_operator("!=", "=="); swap_operator("&&", "||"); swap_operator("[|][|]", "\\&\\&")
    swap_operator("&", "|"); swap_operator("[|]", "\\&"); swap_operator("<<", ">>"); swap_operator(">>", "<<")
    swap_operator("[?]", "== false ?")  # the other case

    word["min"] = "max"; word["max"] = "min"; word["sin"] = "cos"; word["cos"] = "sin"
    word["true"] = "false"; word["false"] = "true"
    word["abs"] = word["sqrt"] = word["floor"] = word["normalize"] = word["unitOr"] = ""  # a call without effect
    component["x"] = "y"; component["y"] = "z"; component["z"] = "x"; component["w"] = "x"
}

function swap_operator(pattern, with) {
    patterns[++operators] = " " pattern " "
    replacements[operators] = " " with " "
}

function mutant(column, span, text) {
    gsub(/\\&/, "\\&", text)
    print FILENAME, FNR, column, span, text
}

# The line with comments and literals replaced by spaces, which keeps the columns, and a space at the end.
function code_of(line,    start) {
    while (match(line, /"([^"\\]|\\.)*"|'([^'\\]|\\.)*'/)) {
        start = RSTART
        line = substr(line, 1, start - 1) blanks(RLENGTH) substr(line, start + RLENGTH)
    }
    if (match(line, /\/\//)) line = substr(line, 1, RSTART - 1)
    return line " "
}

function blanks(count,    text) {
    while (length(text) < count) text = text " "
    return text
}

function change_operators(    i, rest, offset) {
    for (i = 1; i <= operators; ++i) {
        rest = code
        offset = 0
        while (match(rest, patterns[i])) {
            mutant(offset + RSTART, RLENGTH, replacements[i])
            offset += RSTART + RLENGTH - 2  # the blank may belong to the next operator
            rest = substr(code, offset + 1)
        }
    }
}

function change_number(column, token, next_character) {
    if (token ~ /^0x/ || token ~ /^[0-9]+u?$/) {
        if (next_character == "]" && code ~ /\];? *$/) return  # the size of an array
        mutant(column, length(token), "(" token " + 1)")
        mutant(column, length(token), "(" token " - 1)")
        return
    }
    mutant(column, length(token), "(" token " + 1)")
    if (token ~ /^0?[.]0*f?$/) return
    mutant(column, length(token), "(-" token ")")
    if (token ~ /e-/) return  # what only keeps a division from 0: twice as much would do
    mutant(column, length(token), "(" token " * 2)")
    mutant(column, length(token), "(" token " / 2)")
}

function change_tokens(    rest, offset, token, before, after) {
    rest = code
    offset = 0
    while (match(rest, /[A-Za-z_][A-Za-z_0-9]*|0x[0-9a-f]+u?|[0-9]+[.]?[0-9]*(e[-+]?[0-9]+)?[fu]?/)) {
        token = substr(rest, RSTART, RLENGTH)
        offset += RSTART + RLENGTH - 1
        rest = substr(code, offset + 1)
        before = substr(code, offset - length(token), 1)
        after = substr(rest, 1, 1)
        if (token ~ /^[0-9]/)
            change_number(offset - length(token) + 1, token, after)
        else if (before == "." && after != "(" && (token in component))
            mutant(offset - length(token) + 1, length(token), component[token])
        else if (before != "." && (token in word) && (after == "(" || token ~ /^(true|false)$/))
            mutant(offset - length(token) + 1, length(token), word[token])
        else if (token == "continue" || token == "break")
            mutant(offset - length(token) + 1, length(token), "")
    }
}

# Drops a term or a factor that is a name, a member or a call with few arguments.
function drop_operands(    rest, offset, after) {
    rest = code
    offset = 0
    while (match(rest, / [-+*\/] [A-Za-z_0-9.]+(\([^()]*\))?(\[[^][]*\])?/)) {
        after = substr(rest, RSTART + RLENGTH, 2)
        if (after ~ /^(;|,|\)| [-+*\/<>?])/) mutant(offset + RSTART, RLENGTH, "")
        offset += RSTART + 2
        rest = substr(code, offset + 1)
    }
}

function negate_condition(    start, i, depth, character) {
    if (!match(code, /(if|while) \(/)) return
    start = i = RSTART + RLENGTH
    for (depth = 1; depth > 0 && i <= length(code); ++i) {
        character = substr(code, i, 1)
        depth += character == "(" ? 1 : (character == ")" ? -1 : 0)
    }
    if (depth > 0 || index(substr(code, start, i - start), ";")) return
    mutant(start, i - 1 - start, "!(" substr(code, start, i - 1 - start) ")")
}

function drop_assignment() {
    if (match(code, /^ +[a-z_][A-Za-z_0-9.]*(\[[^=]*\])?([.][A-Za-z]+)? [-+*\/|&^]?= .*; +$/))
        mutant(1, length(code) - 1, ";")
}

FNR == 1 { left_out = 0 }
{
    code = code_of($0)
    if (code ~ /^ *(static_assert|assert|template|#)/) left_out = 1
    if (!left_out && code !~ /^ *(using|namespace|enum|HWY_|KERNELS_)/) {
        change_operators()
        change_tokens()
        drop_operands()
        negate_condition()
        drop_assignment()
    }
    if (code ~ /[;{>] *$/ || code ~ /^ *#/) left_out = 0
}
