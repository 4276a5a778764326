// Blocks of the pretrace in which the rays of the first pass are few and meet nothing: later passes take samples there.
#version 3.7;
global_settings {
  assumed_gamma 1
  radiosity { pretrace_start 0.1 pretrace_end 0.02 count 10 recursion_limit 1 }
}
camera { orthographic location -20*z direction z right 16*x up 12*y }
sky_sphere { pigment { gradient y color_map { [0.2 rgb <0.9, 0.4, 0.1>] [0.8 rgb <0.1, 0.5, 1>] } scale 2 translate -y } }
#default { finish { ambient 0 diffuse 0.9 } }
sphere { <-4.1, 3.6, 0>, 0.7 pigment { rgb 1 } }
sphere { <4.6, 2.5, 0>, 0.8 pigment { rgb <1, 0.8, 0.6> } }
sphere { <0.3, -1.1, 0>, 0.75 pigment { rgb <0.7, 1, 0.8> } }
sphere { <-6.2, -3.9, 0>, 0.6 pigment { rgb <0.8, 0.8, 1> } }
sphere { <5.9, -4.4, 0>, 0.7 pigment { rgb 1 } }
