// `#declare (A, B) = (..)` declares several names at once.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare (Ball, Size, Place) = (sphere { -2*x, 0.8 }, 0.6, <2, 0, 0>);
object { Ball pigment { rgb <1, 0.5, 0.2> } }
sphere { Place, Size }
