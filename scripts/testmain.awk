# Writes the Fortran program that runs every test module: `test_X` in tests/FOLDER/test_X.f90 has run_test_X(suite).
# awk -f testmain.awk FILE...
#
# Each module is read by an external procedure of its own: gfortran 12 does not read the modules of all tests into one
# program unit ("Mismatch in components of derived type '__vtype_...'": two orders of one class's slots).

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
   print "   implicit none (type, external)"
   print "   interface"
   for (i = 1; i <= n; i++) {
      printf "      subroutine apart_%s(suite)\n", names[i]
      print "         import :: suite_t"
      print "         implicit none (type, external)"
      print "         type(suite_t), intent(inout) :: suite"
      printf "      end subroutine apart_%s\n", names[i]
   }
   print "   end interface"
   print "   type(suite_t) :: suite"
   print ""
   print "   call suite%start()"
   for (i = 1; i <= n; i++) {
      printf "   suite%%module = \"%s\"\n", names[i]
      printf "   call apart_%s(suite)\n", names[i]
   }
   print "   call suite%finish()"
   print "end program run_tests"
   for (i = 1; i <= n; i++) {
      print ""
      printf "subroutine apart_%s(suite)\n", names[i]
      print "   use check, only: suite_t"
      printf "   use %s, only: run_%s\n", names[i], names[i]
      print "   implicit none (type, external)"
      print "   type(suite_t), intent(inout) :: suite"
      print ""
      printf "   call run_%s(suite)\n", names[i]
      printf "end subroutine apart_%s\n", names[i]
   }
}
