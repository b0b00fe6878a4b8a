!> Interfaces of the LAPACK and BLAS routines that gudgeon calls.
module lapack
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: ddot, dgeev, dgels, dgelsd, dgemv, dgeqp3, dgeqrf, dgesc2, dgesvd, dgetc2, dgetrf, dgetrs, dormqr, dpbtrf, dpbtrs, &
      dsyev
   public :: dsygv, dtrtrs, zgetrf, zgetrs

   interface
      !> Sum of products.
      pure real(wp) function ddot(n, x, incx, y, incy)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: n, incx, incy                !! how many, distances
         real(wp), intent(in) :: x(*)                        !! (n) first factors [any]
         real(wp), intent(in) :: y(*)                        !! (n) second factors [any]
      end function ddot

      !> y = alpha A x + beta y, or with the transpose of A.
      pure subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: wp
         character, intent(in) :: trans           !! N: A, T: its transpose
         integer, intent(in) :: m                 !! rows of A
         integer, intent(in) :: n                 !! columns of A
         real(wp), intent(in) :: alpha            !! factor [1]
         integer, intent(in) :: lda               !! leading dimension of A
         real(wp), intent(in) :: a(lda, *)        !! (lda, n) the matrix A [any]
         integer, intent(in) :: incx              !! distance of the elements of x
         real(wp), intent(in) :: x(*)             !! (n, or m) a vector [any]
         real(wp), intent(in) :: beta             !! factor; 0: y need not be set [1]
         integer, intent(in) :: incy              !! distance of the elements of y
         real(wp), intent(inout) :: y(*)          !! (m, or n) the other vector [any]
      end subroutine dgemv

      !> Least-norm least-squares solution by singular values, with the rank.
      subroutine dgelsd(m, n, nrhs, a, lda, b, ldb, s, rcond, rank, work, lwork, iwork, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, nrhs, lda, ldb, lwork  !! sizes
         real(wp), intent(inout) :: a(lda, *)                !! (lda, n) matrix, destroyed [any]
         real(wp), intent(inout) :: b(ldb, *)                !! (ldb, nrhs) right-hand sides, then solutions [any]
         real(wp), intent(out) :: s(*)                       !! (min(m, n)) singular values [any]
         real(wp), intent(in) :: rcond                       !! smaller singular values count as zero [1]
         integer, intent(out) :: rank                        !! effective rank
         real(wp), intent(out) :: work(*)                    !! (lwork) scratch [any]
         integer, intent(out) :: iwork(*)                    !! scratch
         integer, intent(out) :: info                        !! 0: done
      end subroutine dgelsd

      !> Least-squares solution of a matrix of full rank.
      subroutine dgels(trans, m, n, nrhs, a, lda, b, ldb, work, lwork, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: trans                      !! "N": not transposed
         integer, intent(in) :: m, n, nrhs, lda, ldb, lwork  !! sizes
         real(wp), intent(inout) :: a(lda, *)                !! (lda, n) matrix, then its factors [any]
         real(wp), intent(inout) :: b(ldb, *)                !! (ldb, nrhs) right-hand sides, then solutions [any]
         real(wp), intent(out) :: work(*)                    !! (lwork) scratch [any]
         integer, intent(out) :: info                        !! 0: done
      end subroutine dgels

      !> QR factorisation.
      subroutine dgeqrf(m, n, a, lda, tau, work, lwork, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, lda, lwork  !! sizes
         real(wp), intent(inout) :: a(lda, *)     !! (lda, n) matrix, then its factors [any]
         real(wp), intent(out) :: tau(*)          !! (min(m, n)) reflectors [any]
         real(wp), intent(out) :: work(*)         !! (lwork) scratch [any]
         integer, intent(out) :: info             !! 0: done
      end subroutine dgeqrf

      !> QR factorisation with column pivoting.
      subroutine dgeqp3(m, n, a, lda, jpvt, tau, work, lwork, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, lda, lwork  !! sizes
         real(wp), intent(inout) :: a(lda, *)     !! (lda, n) matrix, then its factors [any]
         integer, intent(inout) :: jpvt(*)        !! (n) order of the columns
         real(wp), intent(out) :: tau(*)          !! (min(m, n)) reflectors [any]
         real(wp), intent(out) :: work(*)         !! (lwork) scratch [any]
         integer, intent(out) :: info             !! 0: done
      end subroutine dgeqp3

      !> Singular values and vectors.
      subroutine dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: jobu, jobvt                 !! A: all vectors
         integer, intent(in) :: m, n, lda, ldu, ldvt, lwork   !! sizes
         real(wp), intent(inout) :: a(lda, *)                 !! (lda, n) matrix, destroyed [any]
         real(wp), intent(out) :: s(*)                        !! (min(m, n)) singular values, descending [any]
         real(wp), intent(out) :: u(ldu, *)                   !! (ldu, m) left vectors, column by column [1]
         real(wp), intent(out) :: vt(ldvt, *)                 !! (ldvt, n) right vectors, row by row [1]
         real(wp), intent(out) :: work(*)                     !! (lwork) scratch [any]
         integer, intent(out) :: info                         !! 0: done
      end subroutine dgesvd

      !> Eigenvalues and vectors of a symmetric matrix.
      subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: jobz, uplo      !! V: vectors too; U: upper triangle
         integer, intent(in) :: n, lda, lwork     !! sizes
         real(wp), intent(inout) :: a(lda, *)     !! (lda, n) matrix, then its eigenvectors [any]
         real(wp), intent(out) :: w(*)            !! (n) eigenvalues, ascending [any]
         real(wp), intent(out) :: work(*)         !! (lwork) scratch [any]
         integer, intent(out) :: info             !! 0: done
      end subroutine dsyev

      !> Eigenvalues of any matrix.
      subroutine dgeev(jobvl, jobvr, n, a, lda, wr, wi, vl, ldvl, vr, ldvr, work, lwork, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: jobvl, jobvr              !! N: no vectors
         integer, intent(in) :: n, lda, ldvl, ldvr, lwork   !! sizes
         real(wp), intent(inout) :: a(lda, *)               !! (lda, n) matrix, destroyed [any]
         real(wp), intent(out) :: wr(*), wi(*)              !! (n) real and imaginary parts of the eigenvalues [any]
         real(wp), intent(out) :: vl(ldvl, *), vr(ldvr, *)  !! (ld, n) eigenvectors, if asked for [1]
         real(wp), intent(out) :: work(*)                   !! (lwork) scratch [any]
         integer, intent(out) :: info                       !! 0: done
      end subroutine dgeev

      !> Eigenvalues of a symmetric matrix against a positive definite one.
      subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: itype                !! 1: a x = w b x
         character, intent(in) :: jobz, uplo         !! N: no vectors; U: upper triangles
         integer, intent(in) :: n, lda, ldb, lwork   !! sizes
         real(wp), intent(inout) :: a(lda, *)        !! (lda, n) symmetric matrix, destroyed [any]
         real(wp), intent(inout) :: b(ldb, *)        !! (ldb, n) positive definite matrix, destroyed [any]
         real(wp), intent(out) :: w(*)               !! (n) eigenvalues, ascending [any]
         real(wp), intent(out) :: work(*)            !! (lwork) scratch [any]
         integer, intent(out) :: info                !! 0: done
      end subroutine dsygv

      !> LU factorisation with complete pivoting; pivots that are too small are raised.
      subroutine dgetc2(n, a, lda, ipiv, jpiv, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: n, lda          !! sizes
         real(wp), intent(inout) :: a(lda, *)   !! (lda, n) matrix, then its factors [any]
         integer, intent(out) :: ipiv(*)        !! (n) row exchanges
         integer, intent(out) :: jpiv(*)        !! (n) column exchanges
         integer, intent(out) :: info           !! 0: no pivot was raised
      end subroutine dgetc2

      !> Solution with the factors of dgetc2.
      subroutine dgesc2(n, a, lda, rhs, ipiv, jpiv, scale)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: n, lda          !! sizes
         real(wp), intent(in) :: a(lda, *)      !! (lda, n) factors [any]
         real(wp), intent(inout) :: rhs(*)      !! (n) right-hand side, then scale times the solution [any]
         integer, intent(in) :: ipiv(*)         !! (n) row exchanges
         integer, intent(in) :: jpiv(*)         !! (n) column exchanges
         real(wp), intent(out) :: scale         !! against overflow, 0 to 1 [1]
      end subroutine dgesc2

      !> LU factorisation with partial pivoting.
      subroutine dgetrf(m, n, a, lda, ipiv, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, lda       !! sizes
         real(wp), intent(inout) :: a(lda, *)   !! (lda, n) matrix, then its factors [any]
         integer, intent(out) :: ipiv(*)        !! (min(m, n)) row exchanges
         integer, intent(out) :: info           !! 0: done; k: pivot k is zero
      end subroutine dgetrf

      !> Solution from the factors of dgetrf.
      subroutine dgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: trans              !! N: no transpose
         integer, intent(in) :: n, nrhs, lda, ldb    !! sizes
         real(wp), intent(in) :: a(lda, *)           !! (lda, n) factors [any]
         integer, intent(in) :: ipiv(*)              !! (n) row exchanges
         real(wp), intent(inout) :: b(ldb, *)        !! (ldb, nrhs) right-hand sides, then solutions [any]
         integer, intent(out) :: info                !! 0: done
      end subroutine dgetrs

      !> Product of the orthogonal matrix of dgeqrf or dgeqp3 with another one.
      subroutine dormqr(side, trans, m, n, k, a, lda, tau, c, ldc, work, lwork, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: side, trans                !! L: from the left; N: not transposed
         integer, intent(in) :: m, n, k, lda, ldc, lwork     !! sizes
         real(wp), intent(in) :: a(lda, *)                   !! (lda, k) reflections as the factorisation left them [any]
         real(wp), intent(in) :: tau(*)                      !! (k) factors of these [1]
         real(wp), intent(inout) :: c(ldc, *)                !! (ldc, n) matrix, then the product [any]
         real(wp), intent(inout) :: work(*)                  !! (lwork) workspace [any]
         integer, intent(out) :: info                        !! 0: done
      end subroutine dormqr

      !> Cholesky factorisation of a symmetric positive definite band matrix.
      subroutine dpbtrf(uplo, n, kd, ab, ldab, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: uplo            !! L: lower band
         integer, intent(in) :: n, kd, ldab       !! order, diagonals beside the main one, leading dimension
         real(wp), intent(inout) :: ab(ldab, *)   !! (ldab, n) band, then its factor [any]
         integer, intent(out) :: info             !! 0: done; k: not positive definite
      end subroutine dpbtrf

      !> Solution from the factor of dpbtrf.
      subroutine dpbtrs(uplo, n, kd, nrhs, ab, ldab, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: uplo                   !! L: lower band
         integer, intent(in) :: n, kd, nrhs, ldab, ldb   !! sizes
         real(wp), intent(in) :: ab(ldab, *)             !! (ldab, n) factor [any]
         real(wp), intent(inout) :: b(ldb, *)            !! (ldb, nrhs) right-hand sides, then solutions [any]
         integer, intent(out) :: info                    !! 0: done
      end subroutine dpbtrs

      !> LU factorisation of a complex matrix with partial pivoting.
      subroutine zgetrf(m, n, a, lda, ipiv, info)
         import :: wp
         implicit none (type, external)
         integer, intent(in) :: m, n, lda          !! sizes
         complex(wp), intent(inout) :: a(lda, *)   !! (lda, n) matrix, then its factors [any]
         integer, intent(out) :: ipiv(*)           !! (min(m, n)) row exchanges
         integer, intent(out) :: info              !! 0: done; k: pivot k is zero
      end subroutine zgetrf

      !> Solution from the factors of zgetrf.
      subroutine zgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: trans              !! N: no transpose
         integer, intent(in) :: n, nrhs, lda, ldb    !! sizes
         complex(wp), intent(in) :: a(lda, *)        !! (lda, n) factors [any]
         integer, intent(in) :: ipiv(*)              !! (n) row exchanges
         complex(wp), intent(inout) :: b(ldb, *)     !! (ldb, nrhs) right-hand sides, then solutions [any]
         integer, intent(out) :: info                !! 0: done
      end subroutine zgetrs

      !> Solution of triangular equations.
      subroutine dtrtrs(uplo, trans, diag, n, nrhs, a, lda, b, ldb, info)
         import :: wp
         implicit none (type, external)
         character, intent(in) :: uplo, trans, diag   !! "U" upper, "N" not transposed, "N" no unit diagonal
         integer, intent(in) :: n, nrhs, lda, ldb     !! sizes
         real(wp), intent(in) :: a(lda, *)            !! (lda, n) matrix [any]
         real(wp), intent(inout) :: b(ldb, *)         !! (ldb, nrhs) right-hand sides, then solutions [any]
         integer, intent(out) :: info                 !! 0: done
      end subroutine dtrtrs
   end interface

end module lapack
