// Every solid with every other: the merge of each pair, by rows the first and by columns the second.
// The fractal stands last and is never the second: POV-Ray 3.7 takes its inside for its outside when it is subtracted.
// compare: channel<=160 pixels<=0.04% because "rays that graze surfaces known to their accuracy, and edges where two surfaces cross"
// size: 330x330
#version 3.7;
global_settings { assumed_gamma 1 }
#include "../include/solids.inc"
camera { orthographic location <0, 0, -50> direction z right 52*x up 52*y }
light_source { <-40, 60, -90> rgb 1 parallel point_at 0 }
background { rgb <0.1, 0.2, 0.3> }
#for (I, 0, Solids - 1)
  #for (J, 0, Solids - 2)
    merge {
      object { Solid[I] pigment { rgb <0.9, 0.7, 0.4> } }
      object { Solid[J] rotate <30, 60, 20> scale 0.8 translate <0.35, 0.2, -0.3> pigment { rgb <0.3, 0.5, 1> } }
      rotate 30*y rotate -25*x
      translate <2.55*(J - 0.5*(Solids - 1)), 2.55*(0.5*(Solids - 1) - I), 0>
    }
  #end
#end
