// Grey of a file with a `gAMA` chunk of 0.45455, as good as undecoded with `assumed_gamma 2.2`.
#version 3.7;
global_settings { assumed_gamma 2.2 }
camera { orthographic location <2, 1.5, -10> right 4*x up 3*y direction z }
plane { z, 0 pigment { image_map { png "images/grey_gamma.png" interpolate 2 } scale 2 } finish { ambient 1 diffuse 0 } }
