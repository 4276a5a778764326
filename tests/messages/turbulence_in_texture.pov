// mistake in line 2: `turbulence` outside of its pattern
sphere { 0, 1 texture { pigment { marble } turbulence 0.5 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
