!> Parameters for expressions of tests, and compiling with them.
module expression_fixture
   use check, only: check_equal
   use errors, only: error_t
   use expression, only: expression_t
   use expression_compile, only: compile_expression, fault_t, symbol_t, symbols_t, symbol_word
   use kind_info, only: dim_angular_speed, dim_frequency, dim_length
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: compile, make_symbols

contains

   !> Parameters of all tests.
   subroutine make_symbols(all)
      type(symbols_t), intent(out) :: all  !! the parameters

      type(symbol_t) :: symbols(5)
      integer :: k

      symbols(1)%name = "w0"
      symbols(1)%number = 3.0_wp
      symbols(1)%dimension = dim_angular_speed
      symbols(2)%name = "r0"
      symbols(2)%number = 0.1_wp
      symbols(2)%dimension = dim_length
      symbols(3)%name = "amplitude"
      symbols(3)%number = 0.125_wp
      symbols(4)%name = "law"
      symbols(4)%kind = symbol_word
      symbols(4)%word = "hertz"
      symbols(5)%name = "soft"
      symbols(5)%number = -0.1_wp
      symbols(5)%dimension = dim_frequency
      symbols(5)%is_soft = .true.
      call all%start(5)
      do k = 1, 5
         call all%add(symbols(k))
      end do
   end subroutine make_symbols

   !> Compile with the parameters above; an error fails the test.
   subroutine compile(error, source, compiled)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: source                  !! the text
      type(expression_t), intent(out) :: compiled         !! the expression

      type(symbols_t) :: symbols
      type(fault_t), allocatable :: fault

      call make_symbols(symbols)
      call compile_expression(source, symbols, .true., compiled, fault)
      if (allocated(fault)) call check_equal(error, fault%message, "", source)
   end subroutine compile

end module expression_fixture
