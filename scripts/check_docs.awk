# Every real (or complex) dummy argument and derived-type component has a `!!` comment on its line; it says the
# shape in parentheses if it is an array, and ends in the unit in brackets: [m/s], [1] if none, [any] if it varies.
# awk -f check_docs.awk FILE...      prints file:line: complaints, exit code 1 if there are any

function complain(text) {
   printf "%s:%d: %s\n", FILENAME, FNR, text
   bad = 1
}

# The code of a line without its comment (an exclamation mark in a string is no comment).
function split_comment(line,   i, c, quote) {
   code = line
   comment = ""
   quote = ""
   for (i = 1; i <= length(line); i++) {
      c = substr(line, i, 1)
      if (quote != "") {
         if (c == quote) quote = ""
      } else if (c == "\"" || c == "'") {
         quote = c
      } else if (c == "!") {
         code = substr(line, 1, i - 1)
         comment = substr(line, i)
         return
      }
   }
}

FNR == 1 { in_type = 0; waiting = 0 }

{
   if ($0 !~ /[^ \t]/ || $0 ~ /^[ \t]*!/) next
   split_comment($0)
   low = tolower(code)
   sub(/^[ \t]+/, "", low)
   sub(/[ \t]+$/, "", low)
   if (low ~ /^type[ \t]*(,[^:]*)?::/ || low ~ /^type[ \t]+[a-z]/ && low !~ /^type[ \t]+is/) in_type = 1
   if (low ~ /^end[ \t]*type/) in_type = 0
   if (low ~ /^contains/) in_type = 0

   # a declaration continued over several lines is judged as a whole, its comment may stand on any of them
   if (waiting) {
      low = held low
      comment = comment == "" ? held_comment : comment
   }
   waiting = low ~ /&$/ && (low ~ /^(real|complex)[ \t]*\(/ || low ~ /^double precision/)
   if (waiting) {
      sub(/&$/, "", low)
      held = low
      held_comment = comment
      next
   }
   held = ""
   if (low !~ /^(real|complex)[ \t,(:]/ && low !~ /^double[ \t]+precision/) next
   at = index(low, "::")
   if (at == 0) next
   attributes = substr(low, 1, at - 1)
   names = substr(low, at + 2)
   if (attributes ~ /parameter/) next
   is_dummy = attributes ~ /intent[ \t]*\(/ || attributes ~ /,[ \t]*(value|optional)([ \t]|,|$)/
   if (!is_dummy && !in_type) next

   is_array = attributes ~ /dimension/ || names ~ /^[^=]*\(/
   match(names, /[a-z][a-z0-9_]*/)
   name = substr(names, RSTART, RLENGTH)
   if (comment !~ /^!![ \t]*[^ \t]/) {
      complain("'" name "' needs a comment !! on its line: meaning and [unit]")
   } else {
      if (comment !~ /\[[^][]+\][ \t]*$/) complain("the comment of '" name "' must end in its unit: [m], [1] ...")
      if (is_array && comment !~ /\([^()]+\)/) complain("the comment of the array '" name "' must say its shape: (3, n)")
   }
}

END { exit bad }
