// Half-spaces under matrices: octahedron and cube are intersections of planes, the cylinder a tube and two planes.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2.5, -8> look_at 0 angle 40 }
light_source { <-3, 6, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare Octahedron = intersection {
  #for (Sx, -1, 1, 2) #for (Sy, -1, 1, 2) #for (Sz, -1, 1, 2)
    plane { <Sx, Sy, Sz>, 1/sqrt(3) }
  #end #end #end
}
#declare Cube = intersection {
  plane { x, 0.7 } plane { -x, 0.7 } plane { y, 0.7 } plane { -y, 0.7 } plane { z, 0.7 } plane { -z, 0.7 }
}
#declare Drum = intersection {
  quadric { <1, 0, 1>, 0, 0, -0.49 }
  plane { y, 0.7 } plane { -y, 0.7 }
}
object { Octahedron pigment { rgb <0.9, 0.7, 0.4> } matrix <1, 0.3, 0, 0, 1, 0.2, 0.4, 0, 1, -2.2, 0, 0> }
object { Cube pigment { rgb <0.4, 0.7, 0.9> } scale <1, 1.3, 0.8> rotate <20, 35, 10> }
object { Drum pigment { rgb <0.6, 0.9, 0.5> } rotate 25*z matrix <1, 0, 0, 0.3, 1, 0, 0, 0, 1.2, 2.2, 0, 0> }
