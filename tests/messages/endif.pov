// mistake in line 4: the end of a condition in other languages
#if (1)
  sphere { 0, 1 }
#endif
box { 0, 1 }
