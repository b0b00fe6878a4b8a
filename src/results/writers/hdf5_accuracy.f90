!> What a run whose accuracy was asked for knows of its errors, in run.h5: the group /accuracy (docs/output.md).
module hdf5_accuracy
   use accuracy_results, only: accuracy_t, claim_words
   use hdf5, only: h5gclose_f, hid_t
   use hdf5_attributes, only: long_attribute, real_attribute, text_attribute
   use hdf5_calls, only: new_group
   use hdf5_datasets, only: real_dataset, text_dataset
   use kinds, only: i8, wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: bytes_of_accuracy, write_accuracy

contains

   !> Space that the group takes at most, but for metadata.
   pure integer(i8) function bytes_of_accuracy(accuracy) result(bytes)
      type(accuracy_t), intent(in) :: accuracy     !! what is known

      integer :: k

      bytes = 0
      if (.not. allocated(accuracy%extremes)) return
      do k = 1, size(accuracy%extremes)
         bytes = bytes + 80_i8 + 2_i8*len(accuracy%extremes(k)%name, i8) + 8_i8*len(accuracy%extremes(k)%unit, i8)
      end do
   end function bytes_of_accuracy

   !> Write the group.
   subroutine write_accuracy(file, accuracy, status)
      integer(hid_t), intent(in) :: file           !! the file
      type(accuracy_t), intent(in) :: accuracy     !! what is known
      integer, intent(inout) :: status             !! negative: failed

      type(text_t), allocatable :: names(:), units(:)
      character(:), allocatable :: all_units
      integer(hid_t) :: group
      integer :: closed, k, n

      call new_group(file, "accuracy", group, status)
      call text_attribute(group, "claim", trim(claim_words(accuracy%claim)), status)
      call real_attribute(group, "asked", accuracy%asked, status)
      call real_attribute(group, "error", accuracy%error, status)
      call real_attribute(group, "error_at_end", accuracy%error_at_end, status)
      call real_attribute(group, "claimed_until", accuracy%until, status)
      call text_attribute(group, "coarser", accuracy%evidence%coarser, status)
      call text_attribute(group, "confirmed_by", accuracy%evidence%confirmation, status)
      call real_attribute(group, "other_contacts_from", accuracy%evidence%other_from, status)
      call text_attribute(group, "reason", accuracy%reason, status)
      call long_attribute(group, "runs", int(accuracy%evidence%runs, i8), status)
      associate (extremes => accuracy%extremes)
         n = size(extremes)
         allocate (names(n), units(n))
         all_units = ""
         do k = 1, n
            names(k)%s = extremes(k)%name
            units(k)%s = extremes(k)%unit
            all_units = trim(all_units//" "//extremes(k)%unit)
         end do
         all_units = trim(adjustl(all_units))
         call text_dataset(file, "accuracy/names", names, .false., "channels with known errors", status)
         call text_dataset(file, "accuracy/units", units, .false., "their units", status)
         call put("scale", extremes%scale, "reference values of relative errors")
         call put("error", extremes%error, "maximum error up to claimed_until, and of the extremes")
         call put("min", extremes%minimum, "minimum up to claimed_until")
         call put("max", extremes%most, "maximum up to claimed_until")
      end associate
      if (group >= 0) call h5gclose_f(group, closed)

   contains

      !> Numbers of the channels.
      subroutine put(name, values, long_name)
         character(*), intent(in) :: name        !! of the dataset
         real(wp), intent(in) :: values(:)       !! (n) the numbers [any]
         character(*), intent(in) :: long_name   !! what they are

         call real_dataset(file, "accuracy/"//name, [n], values, all_units, long_name, status)
      end subroutine put

   end subroutine write_accuracy

end module hdf5_accuracy
