#!/usr/bin/awk -f
# Makes of a public header what doxygen reads of it. Our headers keep three habits that doxygen does not know:
# * a comment at the top is about the file;
# * declarations that follow each other without a blank line share the comment of the first one;
# * in the C header, a comment behind a constant or a field is about that.
# Members that every class has need no words of their own in a header; here they get some.

# Whether the line begins a declaration that nothing has documented yet, and what would be said of it.
function special(line) {
  if (line ~ /~[A-Za-z]+\(\)/) return "Frees what it holds."
  if (line ~ /operator=\(.*&& /) return "Moves."
  if (line ~ /operator=\(/) return "Copies, or moves."
  if (line ~ /operator==\(/) return "Whether all members are equal."
  if (match(line, /^ *(explicit )?[A-Za-z]+\(/)) {
    name = substr(line, RSTART, RLENGTH)
    gsub(/ |\(|explicit/, "", name)
    if (name == class && line ~ "\\(\\) noexcept") return "Makes an empty one."
    if (line ~ "\\(const " name "&[^,]*\\)") return "Copies."
    if (line ~ "\\(" name "&&[^,]*\\)") return "Moves."
  }
  return ""
}

function count(text, character) { return gsub("[" character "]", "", text) }

FNR == 1 { print "/// @file" }

# In C, words behind a constant or a field. They may go on in the next lines.
/^  [^\/]*[^ \/].* \/\* / && FILENAME ~ /\.h$/ { sub(/\/\* /, "/**< ") }

/^ *\/\/\/ / || /^ *\/\/\/$/ {
  if (!in_comment) comment = ""
  in_comment = 1
  comment = comment $0 "\n"
  print
  next
}

{
  documented = in_comment
  in_comment = 0
}

/^#define/ {
  if (!documented && comment != "") printf "%s", comment
  continued = /\\$/
  print
  next
}
continued { continued = /\\$/; print; next }
/^ *$/ || /^#/ { comment = ""; print; next }
/^ *\/\// || /^ *(public|private):/ { comment = ""; print; next }

# A declaration, or what goes on with one.
{
  code = $0
  gsub(/\/[\/*].*/, "", code)
  gsub(/"[^"]*"/, "", code)
  if (!open && body == 0 && code !~ /^ *}/) {
    if (code ~ /^(class|struct) /) {
      class = code
      sub(/^(class|struct) (SHAFTCULL_EXPORT )?/, "", class)
      sub(/[ :;].*/, "", class)
    }
    if (!documented && !after_template && $0 !~ /\/\/\/<|\/\*\*</) {
      words = special(code)
      if (words != "") print "/// " words
      else if (comment != "") printf "%s", comment
    }
  }
  # Scopes hold declarations; other braces are bodies.
  if (body == 0 && !open && code ~ /^ *(namespace|class|struct|enum|typedef struct|extern|template.*(class|struct)).*{ *$/) {
    comment = ""
  } else {
    body += count(code, "{") - count(code, "}")
    if (body < 0) body = 0
  }
  parentheses += count(code, "(") - count(code, ")")
  after_template = code ~ /^ *template <.*> *$/
  open = body > 0 || parentheses > 0 || !after_template && (code !~ /[;{}:,] *$/ && code !~ /^ *$/)
  print
}
