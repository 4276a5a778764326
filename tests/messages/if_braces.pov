// mistake in line 2: braces around what a condition decides
#if (1) {
  sphere { 0, 1 }
}
box { 0, 1 }
