# Checks that links lead somewhere: each file that a page names relative to itself exists, and has the anchor that is named. Reads
# pages in Markdown, whose headings are anchors by GitHub's rule, or in HTML, whose anchors are ids.

function folder_of(path) { return path ~ /\// ? substr(path, 1, match(path, /\/[^\/]*$/) - 1) : "." }

# The path without "." and "..", where these can go.
function normal(path,    part, count, i, kept, result) {
  count = split(path, part, "/")
  kept = 0
  for (i = 1; i <= count; ++i) {
    if (part[i] == "." || (part[i] == "" && i > 1)) continue
    if (part[i] == ".." && kept > 0 && stack[kept] != "..") --kept
    else stack[++kept] = part[i]
  }
  result = stack[1]
  for (i = 2; i <= kept; ++i) result = result "/" stack[i]
  return result
}

function exists(path) {
  if (!(path in known)) known[path] = system("test -e '" path "'") == 0
  return known[path]
}

function anchor(name) { anchors[FILENAME "#" name] = 1 }

function link(target) {
  gsub(/&amp;/, "\\&", target)
  if (target == "" || target ~ /^[a-zA-Z]+:/ || target ~ /^\/\// || target ~ /[<>$']/) return
  sub(/\?[^#]*/, "", target)
  ++links
  from[links] = FILENAME ":" FNR
  to[links] = target
}

FNR == 1 { code = 0; html = FILENAME ~ /\.html$/; ++pages; reached[normal(FILENAME)] = 1 }

html {
  rest = $0
  while (match(rest, /(href|src|id|name)="[^"]*"/)) {
    attribute = substr(rest, RSTART, RLENGTH)
    rest = substr(rest, RSTART + RLENGTH)
    value = attribute
    sub(/^[a-z]+="/, "", value)
    sub(/"$/, "", value)
    if (attribute ~ /^(id|name)/) anchor(value)
    else link(value)
  }
  next
}

/^ *```/ { code = !code; next }
code || /^    [^ *-]/ { next }
/^#+ / {
  name = tolower($0)
  sub(/^#+ +/, "", name)
  gsub(/[].,:;?!'"`()\/*<>&+=@|[]/, "", name)
  gsub(/…/, "", name)
  gsub(/ /, "-", name)
  if (heading[FILENAME "#" name]++) name = name "-" (heading[FILENAME "#" name] - 1)
  anchor(name)
}
{
  rest = $0
  gsub(/`[^`]*`/, "code", rest)
  while (match(rest, /\]\([^() ]+\)/)) {
    link(substr(rest, RSTART + 2, RLENGTH - 3))
    rest = substr(rest, RSTART + RLENGTH)
  }
}

END {
  omitted["nested-classes"] = omitted["define-members"] = 1  # doxygen's own links to sections that it then leaves out
  for (i = 1; i <= links; ++i) {
    page = from[i]
    sub(/:[0-9]+$/, "", page)
    path = to[i]
    sub(/#.*/, "", path)
    name = to[i] ~ /#/ ? to[i] : ""
    sub(/^[^#]*#/, "", name)
    file = path == "" ? page : path ~ /^\// ? normal(substr(path, 2)) : normal(folder_of(page) "/" path)  # / is the site
    if (file ~ /\/$/ || file == "") file = file "index.html"
    if (!exists(file)) {
      print from[i] ": " to[i] " does not exist"
      bad = 1
    } else if (name != "" && name !~ /^__/ && !(page ~ /^reference/ && name in omitted) && (file in reached) && !((file "#" name) in anchors)) {
      print from[i] ": " to[i] " has no such anchor"
      bad = 1
    }
  }
  print links " links of " pages " pages"
  if (links < least) { print "fewer than " least; bad = 1 }
  exit bad
}
