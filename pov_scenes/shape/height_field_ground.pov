// Level ground at y = 0, where the last digit of a hit decides between the two ends of a gradient.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.7, 0.6, -0.5> look_at <0.5, 0, 0.5> angle 60 }
background { rgb <0.1, 0.2, 0.3> }
height_field {
  function 20, 23 { max(0, 0.3*sin(7*x)*cos(9*y)) }
  pigment { gradient y color_map { [0 rgb <0.2, 0.6, 0.1>] [0.3 rgb <0.7, 0.6, 0.4>] [1 rgb <1, 0.2, 0.2>] } }
  finish { ambient 1 diffuse 0 reflection 0.2 }
}
