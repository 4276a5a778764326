// 256 instances of one ellipsoid, in 16 rotations about x by 16 about z.
// size: 240x240
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -30> direction z right 34*x up 34*y }
light_source { <-20, 30, -60> rgb 1 parallel point_at 0 }
background { rgb <0.9, 0.92, 0.95> }
#declare Ellipsoid = sphere {
  0, 1
  pigment { gradient y color_map { [0 rgb <1, 0.3, 0.1>] [1 rgb <0.2, 0.4, 1>] } scale 2 translate -y }
  finish { phong 0.4 }
  scale <0.5, 1, 0.3>
}
#for (Row, 0, 15)
  #for (Column, 0, 15)
    object { Ellipsoid rotate 11.25*Row*x rotate 11.25*Column*z translate <2.1*(Column - 7.5), 2.1*(7.5 - Row), 0> }
  #end
#end
