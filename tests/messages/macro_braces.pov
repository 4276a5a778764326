// mistake in line 2: braces around the body of a macro
#macro Leg(R) {
  sphere { 0, R }
}
Leg(1)
