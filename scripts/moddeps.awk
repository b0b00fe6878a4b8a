# Writes make rules for the modules of Fortran sources: one program unit per file, file name = name of the
# module or submodule. An object depends on the .mod files of what it uses; a .mod depends on the object
# that makes it, with a recipe that only compiles again if the file is gone. gfortran leaves an unchanged
# .mod untouched, so users are compiled again only when an interface has changed. Text that a source
# includes is named from its directory.
#
# awk -v obj=DIR -v mod=DIR -v gen=DIR -f moddeps.awk FILE...   (sources under gen have their objects in obj/gen)

function object_of(path,   stem) {
   stem = path
   sub(/\.[fF]90$/, "", stem)
   if (index(stem, gen "/") == 1) {
      sub(/.*\//, "", stem)
      return obj "/gen/" stem ".o"
   }
   return obj "/" stem ".o"
}

function complain(text) {
   print "moddeps: " text > "/dev/stderr"
   failed = 1
}

# Records that `path` makes the interface file `name`.
function makes(name, path,   stem) {
   if (name in maker) complain(path ": " name " is also made by " maker[name])
   maker[name] = path
   order[++n_made] = name
   stem = path
   sub(/.*\//, "", stem)
   sub(/\.[fF]90$/, "", stem)
   if (stem != word_of[name]) complain(path ": holds '" word_of[name] "'; file and module must have the same name")
}

FNR == 1 { files[++n_files] = FILENAME }

{
   line = tolower($0)
   sub(/^[ \t]+/, "", line)
   if (line ~ /^include[ \t]*["']/) {
      split($0, part, /["']/)
      path = FILENAME
      sub(/[^\/]*$/, "", path)
      included[FILENAME] = included[FILENAME] " " path part[2]
      next
   }
   if (line !~ /^(module|submodule|use)[ \t,(:]/) next
   sub(/[ \t]*!.*/, "", line)
}

line ~ /^module[ \t]+[a-z][a-z0-9_]*[ \t]*$/ {
   split(line, part, /[ \t]+/)
   word_of[part[2] ".mod"] = part[2]
   makes(part[2] ".mod", FILENAME)
   next
}

# submodule (ancestor[:parent]) name
line ~ /^submodule[ \t]*\(/ {
   gsub(/[ \t]/, "", line)
   sub(/^submodule\(/, "", line)
   split(line, part, /\)/)
   n = split(part[1], family, /:/)
   needs[FILENAME] = needs[FILENAME] " " (n == 1 ? family[1] ".smod" : family[1] "@" family[2] ".smod")
   parent_module[family[1]] = 1
   word_of[family[1] "@" part[2] ".smod"] = part[2]
   makes(family[1] "@" part[2] ".smod", FILENAME)
   next
}

line ~ /^use[ \t,:]/ && line !~ /^use[ \t]*,[ \t]*intrinsic/ {
   sub(/^use[ \t]*(,[ \t]*non_intrinsic)?[ \t]*(::)?[ \t]*/, "", line)
   match(line, /^[a-z0-9_]+/)
   name = substr(line, 1, RLENGTH)
   if (line !~ /^[a-z0-9_]+[ \t]*=/) needs[FILENAME] = needs[FILENAME] " " name ".mod"
}

END {
   if (failed) exit 1
   # a module with submodules also makes module.smod, in the same compilation
   for (i = 1; i <= n_made; i++) {
      name = order[i]
      stem = name
      sub(/\.mod$/, "", stem)
      if (stem in parent_module) {
         maker[stem ".smod"] = maker[name]
         twin[stem ".smod"] = name
         order[++n_made] = stem ".smod"
      }
   }
   printf "interfaces :="
   for (i = 1; i <= n_made; i++) printf " %s/%s", mod, order[i]
   print ""
   for (i = 1; i <= n_made; i++) {
      name = order[i]
      printf "%s/%s: %s%s\n", mod, name, object_of(maker[name]), (name in twin) ? " " mod "/" twin[name] : ""
      printf "\t$(call compile_if_gone,%s)\n", maker[name]
   }
   for (i = 1; i <= n_files; i++) {
      n = split(needs[files[i]], need, " ")
      list = included[files[i]]
      for (j = 1; j <= n; j++) {
         if (!(need[j] in maker) || maker[need[j]] == files[i]) continue
         if (index(list " ", " " mod "/" need[j] " ") == 0) list = list " " mod "/" need[j]
      }
      if (list != "") print object_of(files[i]) ":" list
   }
}
