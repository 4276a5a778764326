// mistakes in lines 2, 3, 4: directives of other languages
#define R 1
#let Q = 1;
#if (1) sphere { 0, 1 } #elif (2) box { 0, 1 } #end
