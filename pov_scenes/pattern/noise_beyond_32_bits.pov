// Noise of coordinates to both sides of 2^31, where POV-Ray's cells end: from there on it is 0 or 1.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> right 8*x up 6*y look_at 0 }
#macro Strip(Generator, Y)
  box {
    <-4, Y, 0>, <4, Y + 1.9, 1>
    pigment { bozo noise_generator Generator translate -(2147483648 - (Generator = 3 ? 10000000 : 0))*x }
    finish { ambient 1 diffuse 0 }
  }
#end
Strip(1, -2.95)
Strip(2, -0.95)
Strip(3, 1.05)
