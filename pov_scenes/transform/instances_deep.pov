// Instances of instances, six deep: 3^6 balls from one declared ball and six declared unions.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2.5, 2.2, -5> look_at <0, 0.2, 0> angle 40 }
light_source { <-3, 6, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare Part = sphere { 0, 0.6 pigment { rgb <0.9, 0.6, 0.2> } finish { phong 0.5 } }
#for (Level, 1, 6)
  #declare Part = union {
    object { Part scale 0.5 translate 0.8*y }
    object { Part scale 0.5 rotate 40*z translate <0.7, -0.4, 0> }
    object { Part scale <-0.5, 0.5, 0.5> rotate 90*y translate <-0.5, -0.4, 0.5> }
  }
#end
object { Part scale 1.1 }
