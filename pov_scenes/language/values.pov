// Words with values: pi, on, off, yes, no, true, false, x, y, z, u, v, t, clock.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { x*-1.5 + y*0.2, on/2 pigment { rgb <yes, off, no> } }
sphere { 0, pi/6*t.t + clock pigment { rgb <false, true, 0.3> } }
sphere { u*1.5 - v*0.1, 0.5 + 0*z.x pigment { rgb (x + z)*0.8 } }
