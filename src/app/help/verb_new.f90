!> `gudgeon new NAME`: writes a commented deck to start from.
module verb_new
   use console, only: say
   use errors, only: error_t, exit_file, exit_usage, set_error
   use options, only: options_t
   implicit none (type, external)
   private
   public :: new_deck

   character(*), parameter :: template(*) = [character(112) :: &
      "# A slider-crank with clearance in the slider pin. Run it:   gudgeon run NAME.deck", &
      "# Help on every table and key:   gudgeon help   gudgeon help joint revolute", &
      "deck = 1", &
      "", &
      "[scene]", &
      'title    = "My mechanism"', &
      "gravity  = 0 -9.81 m/s^2", &
      "", &
      "[parameters]               # change from the command line:  --set c=0.2mm", &
      "c      = 0.5 mm", &
      "speed  = 3000 rpm", &
      "", &
      "[bodies]                   # initial centre of mass and angle; assembly corrects them", &
      "name     mass[kg]   inertia[kg.m^2]   x[mm]   y[mm]   angle[deg]", &
      "crank    0.30       1.0e-4            25      0       0", &
      "rod      0.21       2.5e-4            110     0       0", &
      "slider   0.14       1.0e-4            170     0       0", &
      "", &
      "[points]                   # fixed in a body, from its centre of mass; ground: from the origin", &
      "name     body     xi[mm]   eta[mm]", &
      "main     ground     0      0", &
      "heel     crank    -25      0", &
      "throw    crank     25      0", &
      "big      rod      -60      0", &
      "small    rod       60      0", &
      "pin      slider     0      0", &
      "", &
      "[joint.revolute]           # ideal joints", &
      "name        i       j", &
      "main        main    heel", &
      "big_end     throw   big", &
      "", &
      "[joint.translational]", &
      "name     i        j        axis", &
      "guide    main     pin      x", &
      "", &
      "[driver.speed]             # rotates j against i of a revolute joint", &
      "name     joint    speed", &
      "motor    main     {speed}", &
      "", &
      "[material]", &
      "name     young[GPa]   poisson   density[kg/m^3]", &
      "steel    207          0.3       7850", &
      "", &
      "[clearance.revolute]       # level: ideal or clearance", &
      "name     bearing   journal   bearing_radius[mm]   clearance   material   level       law      friction", &
      "gudgeon  pin       small     10                   {c}         steel      clearance   impact   sliding", &
      "", &
      "[contact.lankarani_nikravesh]", &
      "name     restitution", &
      "impact   0.9", &
      "", &
      "[friction.ambrosio]        # no friction below v0, full friction above v1", &
      "name      coefficient   v0[m/s]   v1[m/s]", &
      "sliding   0.03          1e-4      1e-3", &
      "", &
      "[analysis.dynamic]", &
      "end         = 2 turns of motor     # or a time: 40 ms", &
      "tolerance   = 1e-8", &
      "", &
      "[output]", &
      "every       = 20 us", &
      "channels    = *", &
      "figures     = slider.velocity slider.acceleration motor.moment gudgeon.orbit animation(last = 1 turns of motor)", &
      "report      = on                   # report.html; more figures: mechanism  strip(n=8)  coupler(small)"]
      !! lines of the deck

contains

   !> Write the template to NAME.deck, unless there is such a file.
   subroutine new_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! no name, or the file cannot be made

      character(:), allocatable :: path
      character(256) :: message
      integer :: k, status, unit

      if (size(options%operands) /= 1) then
         call set_error(error, exit_usage, "'gudgeon new' needs one name: gudgeon new NAME writes NAME.deck")
         return
      end if
      path = options%operands(1)%s
      if (len_trim(path) == 0 .or. path == ".deck" .or. scan(path, new_line("a")) > 0 .or. &
          index("/"//path//"/", "/../") > 0 .or. index(path, "/") == 1 .or. index(path, "/", back=.true.) == len(path)) then
         call set_error(error, exit_usage, "'"//path//"' is not a valid deck name: use a file name in this directory or in "// &
                        "a subdirectory, as in: gudgeon new my")
         return
      end if
      if (len(path) < 5) then
         path = path//".deck"
      else if (path(len(path) - 4:) /= ".deck") then
         path = path//".deck"
      end if
      open (newunit=unit, file=path, status="new", action="write", iostat=status, iomsg=message)
      if (status /= 0) then
         call set_error(error, exit_file, "cannot make '"//path//"': "//trim(message)//new_line("a")// &
                        "  = the directory must exist, and an existing file is not overwritten")
         return
      end if
      do k = 1, size(template)
         write (unit, "(a)", iostat=status, iomsg=message) trim(template(k))
         if (status /= 0) exit
      end do
      if (status == 0) close (unit, iostat=status, iomsg=message)
      if (status /= 0) then
         call set_error(error, exit_file, "cannot write '"//path//"': "//trim(message))
         return
      end if
      call say(path//" written. Run it:   gudgeon run "//path)
   end subroutine new_deck

end module verb_new
