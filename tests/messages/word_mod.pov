// mistake in line 2: `mod` between its operands
#declare A = 7 mod 2;
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
