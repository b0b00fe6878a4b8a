!> What a run with a required accuracy knows of its errors, as a table: facts of the run, and a row for each channel.
module accuracy_table
   use accuracy_results, only: accuracy_t, claim_window, claim_words
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use result_table, only: in_text_files, only_shown, result_table_t
   use text, only: append_text, real_text, text_t
   implicit none (type, external)
   private
   public :: table_of_accuracy, worst_of

contains

   !> The table.
   function table_of_accuracy(accuracy, growth) result(table)
      type(accuracy_t), intent(in) :: accuracy          !! what is known
      character(*), intent(in) :: growth                !! growth of small errors, in words
      type(result_table_t) :: table                     !! a row for each channel

      type(text_t), allocatable :: names(:), units(:)
      integer :: k, n

      n = size(accuracy%extremes)
      allocate (names(n), units(n))
      do k = 1, n
         names(k)%s = accuracy%extremes(k)%name
         units(k)%s = accuracy%extremes(k)%unit
      end do
      call table%start("extremes", "accuracy", n, "accuracy", "extremes with intervals", "summary.json and in run.h5, /accuracy")
      if (accuracy%claim == claim_window) table%title = "extremes with intervals up to t = "//real_text(accuracy%until, 6)//" s"
      if (.not. all(ieee_is_finite(accuracy%extremes%minimum))) then
         call append_text(table%notes, "-: undefined; a contact point is defined only during contact")
      end if
      table%units = units
      call table%fact("asked", accuracy%asked)
      call table%fact("claim", trim(claim_words(accuracy%claim)))
      call table%fact("error", accuracy%error)
      call table%fact("error_at_end", accuracy%error_at_end)
      call table%fact("claimed_until", accuracy%until)
      call table%fact("asked_until", accuracy%asked_until, formats=in_text_files)
      call table%fact("coarser", accuracy%evidence%coarser)
      call table%fact("coarser_difference", accuracy%evidence%apart(1), formats=in_text_files)
      call table%fact("confirmed_by", accuracy%evidence%confirmation)
      call table%fact("confirmed_difference", accuracy%evidence%apart(2), formats=in_text_files)
      call table%fact("other_contacts_from", accuracy%evidence%other_from)
      call table%fact("limited_by", worst_of(accuracy), formats=in_text_files)
      call table%fact("reason", accuracy%reason)
      if (accuracy%growth%reason == "") call table%fact("growth", growth, formats=in_text_files)
      call table%fact("runs", accuracy%evidence%runs)
      call table%fact("seconds", accuracy%evidence%spent, formats=in_text_files)
      call table%put("name", "1", "channels with known errors", texts=names, dataset="names", heading="channel")
      call table%put("unit", "1", "their units", texts=units, dataset="units")
      associate (extremes => accuracy%extremes)
         call table%put("scale", "rows", "reference values of relative errors", extremes%scale)
         call table%put("error", "rows", "maximum error up to claimed_until, and of the extremes", extremes%error)
         call table%put("min", "rows", "minimum up to claimed_until", extremes%minimum, heading="min", digits=12)
         call table%put("max", "rows", "maximum up to claimed_until", extremes%most, heading="max", digits=12)
         call table%put("error", "rows", "as above", extremes%error, formats=only_shown, heading="+-", digits=2)
      end associate
   end function table_of_accuracy

   !> The channel that limits the accuracy.
   function worst_of(accuracy) result(name)
      type(accuracy_t), intent(in) :: accuracy     !! what is known
      character(:), allocatable :: name            !! of the channel

      name = ""
      if (accuracy%worst > 0) name = accuracy%extremes(accuracy%worst)%name
   end function worst_of

end module accuracy_table
