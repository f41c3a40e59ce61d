#pragma once

// Routines of BLAS and LAPACK that this room calls, by their fixed interface in Fortran: matrices by
// columns, every argument by its address.
extern "C" {
void dgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n,
            const int* k, const double* alpha, const double* a, const int* lda, const double* b,
            const int* ldb, const double* beta, double* c, const int* ldc);
void dsyrk_(const char* half, const char* transposed, const int* n, const int* k,
            const double* alpha, const double* a, const int* lda, const double* beta, double* c,
            const int* ldc);
void dtrsm_(const char* side, const char* half, const char* transpose, const char* unit,
            const int* m, const int* n, const double* alpha, const double* a, const int* lda,
            double* b, const int* ldb);
void dpotrf_(const char* half, const int* n, double* a, const int* lda, int* info);
}
