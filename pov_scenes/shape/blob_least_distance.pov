// Rays ignore hits on a blob that are nearer than 0.01, in units of the scene: through the clear pane, the blobs behind it
// have a hole, the right one where it is clipped. With the small surface of revolution povr has POV-Ray's distances.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -8> look_at 0 angle 40 }
light_source { <4, 6, -8>, 1 }
box { <-3, -2, -0.1>, <3, 2, 0> pigment { rgbt <0.9, 1, 0.95, 0.9> } }
#declare Ball = blob { threshold 0.5 sphere { 0, 1, 1 } }
#declare Radius = sqrt(1 - sqrt(0.5));
object { Ball scale 2 translate <-1.3, 0, 2 * Radius + 0.002> pigment { rgb <0.9, 0.6, 0.2> } }
object {
  Ball scale 2 clipped_by { plane { z, 0 } }
  translate <1.3, 0, 2 * Radius + 0.002> pigment { rgb <0.3, 0.6, 0.9> }
}
sor { 4, <0.1, -0.1>, <0.1, 0>, <0.15, 0.2>, <0.1, 0.3> translate <0, 1, -1> pigment { rgb 0.5 } }
plane { -z, -6 pigment { checker rgb 0.3 rgb 0.7 } }
