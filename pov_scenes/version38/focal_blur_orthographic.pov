// Focal blur of an orthographic camera, about the ray of each pixel.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0.5, -3> look_at <0, 0, 2> right 6*x up 4.5*y aperture 0.6 focal_point <-1.5, 0, 3> blur_samples 7 }
light_source { <1, 2, -1>, rgb 1 }
plane { -z, -8 pigment { checker rgb <0.9, 0.8, 0.7> rgb <0.3, 0.4, 0.6> } }
sphere { <-1.5, 0, 3>, 0.8 pigment { rgb <0.9, 0.3, 0.2> } }
box { <1, -1, 1>, <2, 0.5, 2> pigment { rgb <0.3, 0.8, 0.3> } }
