// Each triangle of a mesh sends the ray of a pixel, from its middle along its normal.
#version 3.7;
global_settings { assumed_gamma 1 }
#macro Fan(N, Way)
  // Triangles under the first N pixels of a picture of 160 by 120, which look apart like a lens.
  #for (I, 0, N - 1)
    #local P = <mod(I, 160) - 79.5, 59.5 - int(I/160), 128>/64;
    triangle { P/16, P/16 + Way*vcross(P, x)/1024, P/16 + vcross(vcross(P, x), P)/1024 }
  #end
#end
camera { mesh_camera { 1 0 mesh { Fan(19200, 1) } } location <0, 0, 0.01> }
background { rgb <0.3, 0.4, 0.6> }
light_source { <3, 5, -4>, rgb 1 }
box { <-4, -1.5, 0.5>, <4, -1, 4> pigment { checker rgb <0.9, 0.8, 0.7>, rgb <0.2, 0.3, 0.5> scale 0.5 } }
sphere { <-0.4, -0.2, 1.5>, 0.6 pigment { rgb <0.8, 0.2, 0.1> } }
box { <0.3, -1, 1>, <0.9, 0.1, 2> pigment { rgb <0.2, 0.6, 0.3> } rotate 10*y }
