!> What the tests use of ARKODE, under the names that it has from SUNDIALS 7 on.
module arkode
#if SUNDIALS_VERSION >= 7
   use farkode_erkstep_mod, only: ferkstepcreate, ferkstepsettable
   use farkode_mod, only: ark_normal, ark_tstop_return, farkodebutchertable_create, farkodebutchertable_free, farkodeevolve, &
      farkodefree, farkodesetfixedstep, farkodesetmaxnumsteps, farkodesetstoptime, farkodesetuserdata, farkodesstolerances
#else
   use farkode_erkstep_mod, only: farkodeevolve => ferkstepevolve, farkodefree => ferkstepfree, &
      farkodesetfixedstep => ferkstepsetfixedstep, farkodesetmaxnumsteps => ferkstepsetmaxnumsteps, &
      farkodesetstoptime => ferkstepsetstoptime, farkodesetuserdata => ferkstepsetuserdata, &
      farkodesstolerances => ferkstepsstolerances, ferkstepcreate, ferkstepsettable
   use farkode_mod, only: ark_normal, ark_tstop_return, farkodebutchertable_create, farkodebutchertable_free
#endif
   implicit none (type, external)
   public
end module arkode
