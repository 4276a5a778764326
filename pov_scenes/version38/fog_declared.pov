// A copy of a declared fog is turbulent, with the noise of the origin where no `turbulence` is set.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
#declare F = fog { distance 5 color rgb <0.3, 0.5, 0.8> }
plane { y, 0 pigment { checker rgb 1, rgb <1, 0.5, 0> } finish { emission 1 diffuse 0 } }
fog { F distance 9 }
