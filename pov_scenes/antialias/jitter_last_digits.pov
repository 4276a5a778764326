// The last digits of jittered rays: planes are black or white by the side of them on which rounding puts a hit.
// switches: +A0.0 +AM1 +R3
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, .7, 0> direction z right 1.3 * x up 1.1 * y }
#declare Side = pigment { gradient y color_map { [0 rgb 0] [1 rgb 1] } scale 1000 }
plane { y, 4 pigment { Side translate 4 * y } finish { ambient 1 diffuse 0 } }
plane { y, -3 pigment { Side translate -3 * y } finish { ambient 1 diffuse 0 } }
