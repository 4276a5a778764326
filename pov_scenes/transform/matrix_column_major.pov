// Sixteen numbers by column, as OpenGL has them, and the twelve of `matrix`: the same numbers without 4, 8, 12 and 16.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -8> look_at 0 angle 40 }
light_source { <-3, 6, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare C = array[16] {
  0.8, 0.6, 0, 0,
  -0.6, 0.8, 0.2, 0,
  0, 0.1, 1.2, 0,
  0.5, -0.2, 0.3, 1
}
// Where x, y, z and the origin go: a column of the one is a row of the other.
#macro Column_major(A)
  matrix <A[0], A[1], A[2], A[4], A[5], A[6], A[8], A[9], A[10], A[12], A[13], A[14]>
#end
#declare Block = box { <-1, -0.6, -0.4>, <1, 0.6, 0.4> pigment { gradient x color_map { [0 rgb <1, 0.4, 0.2>] [1 rgb <0.2, 0.4, 1>] } scale 4 translate -2*x } }
object { Block Column_major(C) translate -1.6*x }
object { Block matrix <0.8, 0.6, 0, -0.6, 0.8, 0.2, 0, 0.1, 1.2, 0.5, -0.2, 0.3> translate 1.6*x }
