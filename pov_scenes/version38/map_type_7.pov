// `map_type 7` is the angular map of light probes.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1.6 pigment { image_map { png "../texture/images/rgb.png" map_type 7 interpolate 2 } rotate 40*y } finish { emission 0.6 diffuse 0.2 } }
