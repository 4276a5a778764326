// Shows the boxes that min_extent and max_extent tell, as frames around the objects.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -9> look_at 0 }
light_source { <5, 8, -6>, 1 }
#macro Framed(Thing, Place)
  #local A = min_extent(Thing); #local B = max_extent(Thing);
  union {
    object { Thing pigment { rgb <0.8, 0.6, 0.3> } }
    #for (I, 0, 1) #for (K, 0, 1)
      #local Y = (I ? A.y : B.y); #local Z = (K ? A.z : B.z); #local X = (K ? A.x : B.x); #local W = (I ? A.z : B.z);
      cylinder { <A.x, Y, Z>, <B.x, Y, Z>, 0.03 pigment { rgb x } }
      cylinder { <X, A.y, W>, <X, B.y, W>, 0.03 pigment { rgb y } }
      cylinder { <X, Y, A.z>, <X, Y, B.z>, 0.03 pigment { rgb z } }
    #end #end
    translate Place
  }
#end
#declare Tube = cylinder { <-0.6, -0.8, -0.4>, <0.5, 0.9, 0.7>, 0.4 }
#declare Cut = difference { sphere { 0, 1 } plane { y, -0.3 } plane { x, 0.2 inverse } }
#declare Turned = union { box { -0.6, 0.6 } sphere { y, 0.4 } rotate <20, 30, 40> }
#declare Clipped = torus { 0.8, 0.3 rotate 50*x clipped_by { box { -0.7, 0.9 } } }
Framed(Tube, <-3, 1.3, 0>)
Framed(Cut, <-0.2, 1.3, 0>)
Framed(Turned, <-2, -1.5, 0>)
Framed(Clipped, <1.8, -1, 0>)
