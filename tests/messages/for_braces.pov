// mistake in line 2: braces around what a loop repeats
#for (I, 0, 2) {
  sphere { I*x, 1 }
}
