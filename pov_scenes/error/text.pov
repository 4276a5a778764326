// Letters, small ones too, cut out of a plate.
// compare: channel<=80 pixels<=0.01% because "one ray through the edge of a letter; why the two differ there is not known"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0.3, -5> look_at 0 angle 40 }
light_source { <-3, 5, -8>, rgb 0.8 }
background { rgb <0.2, 0.3, 0.4> }
difference {
  box { <-1.8, -0.9, 0>, <1.8, 0.9, 0.2> }
  text { ttf "cyrvetic.ttf" "Error" 1, 0 scale 0.9 translate <-1.3, 0, -0.5> }
  text { ttf "timrom.ttf" "against run time, to the least of its bits" 1, 0 scale <0.17, 0.17, 1> translate <-1.5, -0.5, -0.5> }
  rotate 14*y
  pigment { rgb <0.8, 0.7, 0.4> } finish { ambient 0.1 diffuse 0.7 phong 0.3 }
}
