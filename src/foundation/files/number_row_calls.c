/* Rows of numbers in a text file, line by line. The Fortran side is number_rows.f90; comments on the arguments are there. */
#define _GNU_SOURCE

#include <ctype.h>
#include <float.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct rows {
   FILE *file;
   char *line;
   size_t room;
};

struct rows *gudgeon_open_rows(const char *path)
{
   struct rows *rows = calloc(1, sizeof *rows);
   if (rows == NULL) return NULL;
   rows->file = fopen(path, "re");
   if (rows->file != NULL) return rows;
   free(rows);
   return NULL;
}

enum { most_digits = 19, greatest_power = 27 }; /* of an integer of 64 bits; the greatest power of ten whose odd part is one */

static const long double powers[greatest_power + 1] = {1e0L,  1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,  1e7L,  1e8L,  1e9L,
                                                       1e10L, 1e11L, 1e12L, 1e13L, 1e14L, 1e15L, 1e16L, 1e17L, 1e18L, 1e19L,
                                                       1e20L, 1e21L, 1e22L, 1e23L, 1e24L, 1e25L, 1e26L, 1e27L};

static int is_digit(char c) { return (unsigned)(c - '0') < 10; }

/* Goes over digits, which become part of an integer; at most 19 in all are meant. */
static const char *take_digits(const char *at, uint64_t *whole, int *digits)
{
   const char *first = at;
   for (; is_digit(*at); at++) *whole = 10 * *whole + (uint64_t)(*at - '0');
   *digits += (int)(at - first);
   return at;
}

/* A number in decimal digits, as strtod reads it and in a fraction of the time: with at most 19 digits and a moderate power of ten
 * it is an integer times or by a power of ten that are both exact in 64 bits, so that one rounding, and that to double, are all:
 * the double is the nearest one, or in one case of a thousand its neighbour. Whatever else there is strtod reads. */
static double number_at(const char *text, char **end)
{
   const char *at = text;
   while (*at == ' ') at++;
   int is_negative = *at == '-', digits = 0, power = 0;
   if (*at == '-' || *at == '+') at++;
   uint64_t whole = 0;
   at = take_digits(at, &whole, &digits);
   if (*at == '.') {
      const char *point = at + 1;
      at = take_digits(point, &whole, &digits);
      power = -(int)(at - point);
   }
   if (digits == 0 || digits > most_digits || LDBL_MANT_DIG < 64) return strtod(text, end);
   if (*at == 'e' || *at == 'E') {
      const char *mark = at + 1;
      int is_less = *mark == '-', figures = 0;
      if (*mark == '-' || *mark == '+') mark++;
      uint64_t exponent = 0;
      at = take_digits(mark, &exponent, &figures);
      if (figures == 0 || figures > 3) return strtod(text, end);
      power += is_less ? -(int)exponent : (int)exponent;
   }
   if (isalnum((unsigned char)*at) || abs(power) > greatest_power) return strtod(text, end);
   long double size = power < 0 ? (long double)whole / powers[-power] : (long double)whole * powers[power];
   *end = (char *)at;
   return is_negative ? -(double)size : (double)size;
}

/* How many numbers the next line has that is neither blank nor a comment, at most n; 0: there is none. */
int gudgeon_next_row(struct rows *rows, int n, double *row)
{
   while (getline(&rows->line, &rows->room, rows->file) > 0) {
      char *at = rows->line + strspn(rows->line, " \t\r\n");
      if (*at == '\0' || *at == '#') continue;
      int k = 0;
      for (char *end; k < n; k++, at = end) {
         row[k] = number_at(at, &end);
         if (end == at) break;
      }
      return k;
   }
   return 0;
}

void gudgeon_close_rows(struct rows *rows)
{
   fclose(rows->file);
   free(rows->line);
   free(rows);
}
