// Focal blur of a spherical camera whose direction is longer than 1.
#version 3.7;
global_settings { assumed_gamma 1 }
camera {
  spherical location <-1.7,0,-3> direction 2*z right <1.2,0.2,0> look_at <0.3,0,0> angle 160
  aperture 0.25 blur_samples 10 focal_point <0,0,1>
}
light_source { <-4,6,-8>, 1 }
sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb <0.1,0.3,0.8>] } } }
box { -0.3, 0.3 rotate <20,35,0> pigment { rgb <0.7,0.5,0.2> } finish { phong 0.5 } translate <-0.9,1.3,0.8> }
sphere { <-0.2,0.9,0.7>, 0.6 pigment { rgb <0.8,1,0.6> } finish { phong 0.5 } }
sphere { <-1.3,-0.6,-1.2>, 0.3 pigment { rgb <1,0.7,0.7> } finish { phong 0.5 } }
