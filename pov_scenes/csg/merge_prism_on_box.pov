// The cap of a prism on the face of a box in a merge of glass: the face of the box stays, as points on the upper cap are
// outside the prism.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <8, 10, -22> look_at 5*y angle 40 }
light_source { <-20, 30, -30> rgb 1 }
plane { y, -1 pigment { checker rgb 1, rgb 0.5 scale 3 } }
merge {
  prism { 0, 7, 5, <-1, -1>, <-1, 1>, <1, 1>, <1, -1>, <-1, -1> }
  box { <-1, 7, -1>, <1, 8, 1> }
  pigment { rgbft <0.2, 0.4, 1, 0.3, 0.2> }
  no_shadow
  scale <1.5, 1, 1.5>
}
