#include <stdio.h>

__attribute__((constructor)) static void tell(void) {
  FILE* const file = fopen("LOADED", "w");
  if (file != NULL) fclose(file);
}
