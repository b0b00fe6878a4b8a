!> The results of a study of modes as tables: modes, matrices, Campbell diagram, changes of stability.
module modes_tables
   use kinds, only: two_pi, wp
   use modes_results, only: frequency_of, mode_t, modes_study_t, no_growth, ratio_of
   use result_table, only: in_csv, in_hdf5, result_table_t
   use text, only: real_text, text_t, to_text
   implicit none (type, external)
   private
   public :: stability_of, table_of_campbell, table_of_modes, tables_of_matrices, table_of_stability

   real(wp), parameter :: least_shown = 0.05_wp   !! share of a direction that is named [1]
   integer, parameter :: most_shown = 4           !! directions that are named

contains

   !> A row for each mode.
   function table_of_modes(study) result(table)
      type(modes_study_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! modes

      type(text_t), allocatable :: names(:), parts(:)
      real(wp), allocatable :: im(:), re(:), share(:)
      integer :: i, j, k, n

      n = size(study%modes)
      allocate (names(n), parts(study%n_body*size(study%components)), im(0), re(0), share(0))
      do k = 1, n
         associate (mode => study%modes(k))
            names(k)%s = main_shares(study, mode)
            share = [share, reshape(mode%share, [size(mode%share)])]
            re = [re, reshape(mode%shape%re, [size(mode%share)])]
            im = [im, reshape(mode%shape%im, [size(mode%share)])]
         end associate
      end do
      do j = 1, study%n_body
         do i = 1, size(study%components)
            parts(i + size(study%components)*(j - 1))%s = study%bodies(j)%s//"."//study%components(i)%s
         end do
      end do
      associate (modes => study%modes)
         call table%start("modes", "modes", n, title="Frequency [Hz]")
         call table%put("frequency", "Hz", "natural frequency, 0 of a mode that does not oscillate", modes%frequency, &
                        heading="frequency", digits=8)
         call table%put("damping_ratio", "1", "damping ratio; NaN: the eigenvalue is zero", modes%damping_ratio, &
                        heading="damping ratio", digits=6)
         call table%put("re", "1/s", "real part of the eigenvalue, positive: unstable", modes%eigenvalue%re, heading="real part", &
                        digits=8)
         call table%put("im", "rad/s", "imaginary part of the eigenvalue", modes%eigenvalue%im, heading="imaginary part", digits=8)
         call table%put("most_in", "1", "maximum shares of the kinetic energy", texts=names, heading="kinetic energy in", &
                        formats=in_csv)
         call table%put("share", "1", "shares of the kinetic energy", share, shape=[size(parts)], parts=parts)
         call table%put("shape_re", "list", "local displacements and turns, real part", re, shape=[size(parts)], formats=in_hdf5)
         table%units = units_of(n)
         call table%put("shape_im", "list", "local displacements and turns, imaginary part", im, shape=[size(parts)], &
                        formats=in_hdf5)
      end associate
   end function table_of_modes

   !> Units of shapes, which are those of any scale.
   pure function units_of(n) result(units)
      integer, intent(in) :: n        !! rows
      type(text_t) :: units(n)        !! (n) units

      integer :: k

      do k = 1, n
         units(k)%s = "m or rad"
      end do
   end function units_of

   !> Stability of the state, as text; blank without modes.
   function stability_of(study) result(words)
      type(modes_study_t), intent(in) :: study     !! the study
      character(:), allocatable :: words           !! stable, marginally stable or unstable, and how fast

      real(wp) :: growth, scale

      words = ""
      if (size(study%modes) == 0) return
      growth = maxval(study%modes%eigenvalue%re)
      scale = maxval(abs(study%modes%eigenvalue))
      if (growth > no_growth*scale) then
         words = "unstable: a mode grows e-fold in "//real_text(1.0_wp/growth, 4)//" s"
      else if (growth < -no_growth*scale) then
         words = "asymptotically stable: the slowest mode decays e-fold in "//real_text(-1.0_wp/growth, 4)//" s"
      else
         words = "marginally stable: a mode neither grows nor decays"
      end if
   end function stability_of

   !> The directions of bodies that take part most.
   function main_shares(study, mode) result(words)
      type(modes_study_t), intent(in) :: study     !! for the names
      type(mode_t), intent(in) :: mode             !! the mode
      character(:), allocatable :: words           !! as "rotor.y 0.93, shaft.x 0.07"

      real(wp) :: left(size(mode%share, 1), size(mode%share, 2))
      integer :: at(2), k

      left = mode%share
      words = ""
      do k = 1, most_shown
         if (size(left) == 0) exit
         at = maxloc(left)
         if (left(at(1), at(2)) < least_shown) exit
         if (k > 1) words = words//", "
         words = words//study%bodies(at(2))%s//"."//study%components(at(1))%s//" "//real_text(left(at(1), at(2)), 2)
         left(at(1), at(2)) = 0.0_wp
      end do
   end function main_shares

   !> States with A and B, outputs with C and D, inputs.
   function tables_of_matrices(study) result(tables)
      type(modes_study_t), intent(in) :: study    !! the study
      type(result_table_t) :: tables(3)           !! (3) inputs, states, outputs

      type(text_t), allocatable :: names(:), quantities(:), units(:)
      real(wp), allocatable :: moved(:, :)
      integer :: k, n_part

      associate (model => study%model, inputs => tables(1), states => tables(2), outputs => tables(3))
         call inputs%start("inputs", "inputs", size(model%inputs))
         call inputs%put("name", "1", "input: a load, or a driver's displacement and its rates", texts=model%inputs)
         call inputs%put("unit", "1", "SI", texts=model%input_units)
         n_part = size(model%mass)
         allocate (names(model%n_state), moved(n_part, model%n_state))
         moved = 0.0_wp
         do k = 1, model%n_state
            if (k <= 2*model%n_free) then
               names(k)%s = trim(merge("x    ", "speed", k <= model%n_free))//to_text(modulo(k - 1, max(1, model%n_free)) + 1)
               moved(:, k) = model%direction(:, modulo(k - 1, model%n_free) + 1)
            else
               names(k) = model%others(k - 2*model%n_free)
            end if
         end do
         call states%start("states", "states", model%n_state)
         call states%put("name", "1", "x: displacements, speed: their rates, bristle: states of friction, state: of the "// &
                         "deck", texts=names)
         if (model%n_state > 0) then
            call states%put("a", "1", "matrix A, a row for each state, SI", [transpose(model%a)], shape=[model%n_state])
            if (size(model%inputs) > 0) call states%put("b", "1", "matrix B, a row for each state, SI", [transpose(model%b)], &
                                                        shape=[size(model%inputs)])
            if (n_part > 0) call states%put("direction", "1", "local displacements of all bodies that x moves, or their rates", &
                                            [moved], shape=[n_part])
         end if
         allocate (quantities(size(study%plan%outputs)), units(size(study%plan%outputs)))
         do k = 1, size(quantities)
            quantities(k)%s = study%plan%outputs(k)%name
            units(k)%s = study%plan%outputs(k)%unit
         end do
         call outputs%start("outputs", "outputs", size(quantities))
         call outputs%put("name", "1", "channel", texts=quantities)
         call outputs%put("unit", "1", "SI", texts=units)
         if (size(quantities) == 0) return
         if (model%n_state > 0) call outputs%put("c", "1", "matrix C, a row for each output, SI", [transpose(model%c)], &
                                                 shape=[model%n_state])
         if (size(model%inputs) > 0) call outputs%put("d", "1", "matrix D, a row for each output, SI", [transpose(model%d)], &
                                                      shape=[size(model%inputs)])
      end associate
   end function tables_of_matrices

   !> A row for each mode at each value of the parameter.
   function table_of_campbell(study) result(table)
      type(modes_study_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! the diagram

      complex(wp), allocatable :: values(:)
      real(wp), allocatable :: p(:)
      integer, allocatable :: branch(:)
      type(text_t), allocatable :: units(:)
      integer :: i, k

      allocate (values(0), p(0), branch(0))
      do k = 1, size(study%points)
         associate (point => study%points(k))
            values = [values, point%eigenvalues]
            branch = [branch, point%branch]
            p = [p, (point%p, i=1, size(point%branch))]
         end associate
      end do
      allocate (units(size(p)))
      do k = 1, size(p)
         units(k)%s = study%plan%unit
      end do
      call table%start("campbell", "campbell", size(p))
      call table%put("parameter", "list", "value of the parameter", p)
      table%units = units
      call table%put("branch", "1", "number of the branch", integers=branch)
      call table%put("frequency", "Hz", "natural frequency, 0 of a mode that does not oscillate", frequency_of(values))
      call table%put("damping_ratio", "1", "damping ratio; NaN: the eigenvalue is zero", ratio_of(values))
      call table%put("re", "1/s", "real part of the eigenvalue", values%re)
      call table%put("im", "rad/s", "imaginary part of the eigenvalue", values%im)
   end function table_of_campbell

   !> A row for each change of stability.
   function table_of_stability(study) result(table)
      type(modes_study_t), intent(in) :: study    !! the study
      type(result_table_t) :: table               !! changes

      type(text_t), allocatable :: units(:), words(:)
      integer :: k

      associate (onsets => study%onsets)
         allocate (units(size(onsets)), words(size(onsets)))
         do k = 1, size(onsets)
            units(k)%s = study%plan%unit
            words(k)%s = trim(merge("unstable", "stable  ", onsets(k)%is_loss))
         end do
         call table%start("stability", "stability", size(onsets), title="Changes of stability")
         call table%put("parameter", "list", "value of the parameter", onsets%p, heading=study%plan%parameter, digits=10)
         table%units = units
         call table%put("beyond", "1", "stability at the next value: stable or unstable", texts=words, heading="beyond")
         call table%put("frequency", "Hz", "of the mode that changes", abs(onsets%eigenvalue%im)/two_pi, &
                        heading="frequency", digits=8)
      end associate
   end function table_of_stability

end module modes_tables
