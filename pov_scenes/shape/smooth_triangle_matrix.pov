// Smooth triangles behind matrices: a matrix leaves the corners' normals longer or shorter, a scale does not.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -8> look_at 0 angle 40 }
light_source { <2, 6, -8> rgb 1 }
#declare Shape = smooth_triangle {
  <-1, -0.8, 0>, <-0.3, -0.3, -1>, <1, -0.6, 0.2>, <0.4, -0.2, -1>, <-0.2, 1, -0.2>, <0, 0.5, -1>
  pigment { rgb <0.9, 0.7, 0.3> } finish { diffuse 0.7 phong 0.4 }
}
object { Shape matrix <1, 0, 0, 0, 1, 0, 0, 0.9, 1, 0, 0, 0> translate <-1.6, 1, 0> }
object { Shape matrix <1, 0, 0.8, 0, 1, 0, 0.5, 0, 1, 0, 0, 0> translate <1.6, 1, 0> }
object { Shape scale <1, 1.4, 2> matrix <1, 0.3, 0, 0, 1, 0.7, 0, 0, 1, 0, 0, 0> scale 0.9 rotate 20 * y translate <-1.6, -1.2, 0> }
object { Shape transform { scale <1, 0.6, 2> rotate 30 * z } translate <1.6, -1.2, 0> }
// Scaled so that a normal comes to lie on the other side of the face: nothing is left.
object { Shape scale <1, 0.2, 1> translate <0, 2.4, 0> }
