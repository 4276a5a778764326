// `octaves`, `omega` and `lambda` in a fog make it turbulent, with the noise of the origin.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
plane { y, 0 pigment { checker rgb 1, rgb <1, 0.5, 0> } finish { emission 1 diffuse 0 ambient 0 } }
fog { distance 5 color rgb <0.3, 0.5, 0.8> octaves 3 lambda 2.5 omega 0.6 }
