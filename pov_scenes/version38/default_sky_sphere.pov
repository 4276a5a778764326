// The pigments of a sky sphere begin with version 3.8's default as well.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
sky_sphere { pigment { } }
sphere { 0, 1 pigment { rgb 0.5 } finish { emission 1 } }
