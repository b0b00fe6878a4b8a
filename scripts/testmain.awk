# Writes the Fortran program that runs every test module: `test_X` in tests/FOLDER/test_X.f90 has run_test_X(suite).
# awk -f testmain.awk FILE...

BEGIN {
   n = 0
   for (i = 1; i < ARGC; i++) {
      name = ARGV[i]
      sub(/.*\//, "", name)
      sub(/\.f90$/, "", name)
      names[++n] = name
   }
   print "!> Runs the Fortran tests (made by scripts/testmain.awk)."
   print "program run_tests"
   print "   use check, only: suite_t"
   for (i = 1; i <= n; i++) printf "   use %s, only: run_%s\n", names[i], names[i]
   print "   implicit none (type, external)"
   print "   type(suite_t) :: suite"
   print ""
   print "   call suite%start()"
   for (i = 1; i <= n; i++) {
      printf "   suite%%module = \"%s\"\n", names[i]
      printf "   call run_%s(suite)\n", names[i]
   }
   print "   call suite%finish()"
   print "end program run_tests"
}
