!> The word that was probably meant, by Damerau and Levenshtein's distance between words.
!>
!> Source: F. J. Damerau, A technique for computer detection and correction of spelling errors, Comm. ACM 7 (1964) 171-176.
!> Limits: words of up to 80 characters; letters of any case are the same.
module spelling
   use text, only: lower, split_blank, starts_with, text_t
   implicit none (type, external)
   private
   public :: nearest_word

   !> The candidate that a misspelt word probably meant, or an empty string.
   interface nearest_word
      module procedure :: nearest_of_list
      module procedure :: nearest_of_blank
   end interface nearest_word

contains

   !> The nearest of a list.
   pure function nearest_of_list(word, candidates) result(nearest)
      character(*), intent(in) :: word              !! as written
      type(text_t), intent(in) :: candidates(:)     !! (n) words that would be right
      character(:), allocatable :: nearest          !! one of them, or empty if none is close

      integer :: best, distance, i, limit

      nearest = ""
      limit = max(1, (len(word) + 1)/3)
      best = min(limit, len(word) - 1) + 1
      if (len(word) == 0 .or. len(word) > 80) return
      do i = 1, size(candidates)
         if (abs(len(candidates(i)%s) - len(word)) >= best) cycle
         distance = edit_distance(lower(word), lower(candidates(i)%s))
         if (distance < best .and. distance < max(len(word), len(candidates(i)%s))) then
            best = distance
            nearest = candidates(i)%s
         end if
      end do
      if (len(nearest) > 0 .or. len(word) < 3) return
      do i = 1, size(candidates)
         if (starts_with(lower(candidates(i)%s), lower(word))) then
            nearest = candidates(i)%s
            return
         end if
      end do
   end function nearest_of_list

   !> The nearest of a string of blank-separated words.
   pure function nearest_of_blank(word, candidates) result(nearest)
      character(*), intent(in) :: word        !! as written
      character(*), intent(in) :: candidates  !! blank-separated words that would be right
      character(:), allocatable :: nearest    !! one of them, or empty if none is close

      nearest = nearest_of_list(word, split_blank(candidates))
   end function nearest_of_blank

   !> Damerau-Levenshtein distance: letters inserted, omitted, changed, or two neighbours swapped.
   pure integer function edit_distance(a, b)
      character(*), intent(in) :: a  !! one word
      character(*), intent(in) :: b  !! the other

      integer :: cost(0:len(a), 0:len(b)), i, j, change

      do i = 0, len(a)
         cost(i, 0) = i
      end do
      do j = 1, len(b)
         cost(0, j) = j
         do i = 1, len(a)
            change = merge(0, 1, a(i:i) == b(j:j))
            cost(i, j) = min(cost(i - 1, j) + 1, cost(i, j - 1) + 1, cost(i - 1, j - 1) + change)
            if (i < 2 .or. j < 2) cycle
            if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) then
               cost(i, j) = min(cost(i, j), cost(max(i - 2, 0), max(j - 2, 0)) + 1)
            end if
         end do
      end do
      edit_distance = cost(len(a), len(b))
   end function edit_distance

end module spelling
