// mistake in line 2: braces around both branches
#if (1) {
  sphere { 0, 1 }
} #else {
  box { 0, 1 }
}
