// mistake in line 2: the loop of C
for (int i = 0; i < 10; i++) {
  sphere { i*x, 1 pigment { rgb 1 } }
}
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
