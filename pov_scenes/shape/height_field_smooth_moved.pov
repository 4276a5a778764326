// The normals of a smooth height field are mixed after its transforms.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.6, 1.3, -1.1> look_at <0.5, 0.35, 0.5> }
light_source { <-3, 5, -4> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
height_field {
  png "heights/deep.png" smooth
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
  translate -0.5 scale <2, 0.3, 1> rotate <-20, 30, 10> translate 0.5
}
