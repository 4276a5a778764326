// Comments of both kinds; those of the second kind nest.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { /* the place */ <-0.5, 0, 0>, /* the /* nested */ radius */ 0.8 // to the end of the line }
  pigment { rgb <0.9, /* 0.1, */ 0.6, 0.2> } /* sphere { 0, 9 } // */
}
/**/ /***/ /* // */ sphere { <1, 0.3, 0>, 0.4 pigment { rgb <0.3, 0.6, 0.9> } }
