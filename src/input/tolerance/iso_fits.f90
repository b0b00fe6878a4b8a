!> Limits of holes, shafts and their clearance by ISO 286: tolerance classes as H7 and f7, fits as H7/f7.
!>
!> A class is a fundamental deviation, by its letter, and a tolerance by its grade IT5 to IT11, both by ranges of the diameter up to
!> 500 mm. Holes D to H lie above the nominal diameter, EI = -es of the shaft of the same letter; shafts d to h lie below it.
!> H and h start at it, JS and js lie on both sides.
!>
!> Source: ISO 286-1:2010, table 1 (grades) and tables 2 and 4 (fundamental deviations), as reprinted in handbooks; the numbers
!> were compared with two public reprints, which agree. Limits: letters D to H, JS, d to h, js; no interference fits.
module iso_fits
   use kinds, only: wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: class_limits, read_fit

   real(wp), parameter :: micrometre = 1.0e-6_wp   !! unit of the tables [m]
   integer, parameter :: n_range = 13              !! ranges of the diameter
   integer, parameter :: first_grade = 5           !! IT5
   integer, parameter :: last_grade = 11           !! IT11
   integer, parameter :: upto(n_range) = [3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500]
      !! last diameter of each range [mm]
   integer, parameter :: grades(n_range, first_grade:last_grade) = reshape([ &
      4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27, &
      6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40, &
      10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63, &
      14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97, &
      25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155, &
      40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250, &
      60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400], [n_range, last_grade - first_grade + 1])
      !! tolerances [um]
   character(*), parameter :: letters = "defgh"    !! of shafts; those of holes are upper case
   integer, parameter :: deviations(n_range, len(letters)) = reshape([ &
      20, 30, 40, 50, 65, 80, 100, 120, 145, 170, 190, 210, 230, &
      14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125, 135, &
      6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62, 68, &
      2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18, 20, &
      0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [n_range, len(letters)])
      !! magnitude of the fundamental deviation [um]

contains

   !> Limits of the classes of a fit, less the nominal diameter: hole and shaft of `H7/f7`, or one class.
   pure subroutine read_fit(words, diameter, n, limits, message)
      character(*), intent(in) :: words                    !! as in a deck
      real(wp), intent(in) :: diameter                     !! nominal diameter [m]
      integer, intent(out) :: n                            !! classes: 2 of a fit, else 1
      real(wp), intent(out) :: limits(2, 2)                !! (2, classes) lower and upper deviation of hole and shaft [m]
      character(:), allocatable, intent(out) :: message    !! what is wrong; blank: nothing

      integer :: slash

      limits = 0.0_wp
      slash = index(words, "/")
      n = merge(2, 1, slash > 0)
      if (n == 1) then
         call class_limits(words, diameter, limits(:, 1), message)
         return
      end if
      call class_limits(words(:slash - 1), diameter, limits(:, 1), message)
      if (message == "") call class_limits(words(slash + 1:), diameter, limits(:, 2), message)
      if (message /= "") return
      if (.not. is_hole(words(1:1)) .or. is_hole(words(slash + 1:slash + 1))) then
         message = "a fit is HOLE/SHAFT, as H7/f7: capital letters are holes"
      else if (limits(1, 1) < limits(2, 2)) then
         message = "the clearance of this fit may be negative"
      end if
   end subroutine read_fit

   !> Lower and upper deviation of a tolerance class.
   pure subroutine class_limits(words, diameter, limits, message)
      character(*), intent(in) :: words                    !! as H7
      real(wp), intent(in) :: diameter                     !! nominal diameter [m]
      real(wp), intent(out) :: limits(2)                   !! (2) lower and upper deviation [m]
      character(:), allocatable, intent(out) :: message    !! what is wrong; blank: nothing

      character(:), allocatable :: name
      real(wp) :: width
      integer :: at, grade, range, status

      limits = 0.0_wp
      message = "use the letters D to H, JS, d to h, js and the grades 5 to 11, as H7, f7 or H7/f7"
      at = verify(words, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ")
      if (at < 2 .or. len(words) > at + 1) return
      if (verify(words(at:), "0123456789") > 0) return
      read (words(at:), *, iostat=status) grade
      if (status /= 0 .or. grade < first_grade .or. grade > last_grade) return
      name = words(:at - 1)
      if (is_hole(name)) name = achar(iachar(name(1:1)) + 32)//name(2:)
      if (name == "jS") name = "js"
      if (name /= "js" .and. (len(name) /= 1 .or. index(letters, name) == 0)) return
      message = ""
      range = findloc(diameter*1.0e3_wp <= upto*(1.0_wp + 1.0e-12_wp), .true., dim=1)
      if (range == 0 .or. diameter <= 0.0_wp) then
         message = "the diameter must be positive and at most "//to_text(upto(n_range))//" mm"
         return
      end if
      width = grades(range, grade)*micrometre
      if (name == "js") then
         limits = [-0.5_wp, 0.5_wp]*width
      else if (is_hole(words)) then
         limits = deviations(range, index(letters, name))*micrometre + [0.0_wp, width]
      else
         limits = -deviations(range, index(letters, name))*micrometre - [width, 0.0_wp]
      end if
   end subroutine class_limits

   !> Whether a class is that of a hole.
   pure logical function is_hole(words)
      character(*), intent(in) :: words   !! the class

      is_hole = scan(words(1:min(1, len(words))), "ABCDEFGHIJKLMNOPQRSTUVWXYZ") == 1
   end function is_hole

end module iso_fits
