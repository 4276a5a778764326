// mistake in line 5: a lathe of more points than it announces
#version 3.7;
camera { location -5*z look_at 0 }
light_source { -9*z, rgb 1 }
lathe { linear_spline 2, <1, 2>, <3, 4>, <5, 6> pigment { rgb 1 } }
