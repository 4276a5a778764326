// The fonts that come with POV-Ray are called by numbers.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 1.5, -5> look_at <2, 0.3, 0> }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
text { internal 1 "One 1" 0.5, 0 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } translate 0.9*y }
text { internal 2 "Two 2" 0.5 0 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } }
text { internal 3, "Tri 3" 0.5, 0 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } translate -0.9*y }
text { internal 4, "POV" 0.5, 0 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } translate <2.5, 0, 0> }
