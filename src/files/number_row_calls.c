/* Rows of numbers in a text file, line by line. The Fortran side is number_rows.f90; comments on the arguments are there. */
#define _GNU_SOURCE

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

/* How many numbers the next line has that is neither blank nor a comment, at most n; 0: there is none. */
int gudgeon_next_row(struct rows *rows, int n, double *row)
{
   while (getline(&rows->line, &rows->room, rows->file) > 0) {
      char *at = rows->line + strspn(rows->line, " \t\r\n");
      if (*at == '\0' || *at == '#') continue;
      int k = 0;
      for (char *end; k < n; k++, at = end) {
         row[k] = strtod(at, &end);
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
