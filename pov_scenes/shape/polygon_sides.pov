// Sides of polygons, which follow the order of their first points.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,0,-6> look_at 0 }
light_source { <-4,6,-8>, 1 }
#declare Sides = texture { pigment { rgb <1,0.3,0.2> } }
#declare Back = texture { pigment { rgb <0.2,0.4,1> } }
polygon { 4, <-1,-1>,<1,-1>,<0,1>,<-1,-1> translate <-2.2,1.1,0> texture { Sides } interior_texture { Back } }
polygon { 4, <-1,-1>,<0,1>,<1,-1>,<-1,-1> translate <0,1.1,0> texture { Sides } interior_texture { Back } }
polygon { 6, <-1,-1>,<0,0.05>,<1,-1>,<1,1>,<-1,1>,<-1,-1> translate <2.2,1.1,0> texture { Sides } interior_texture { Back } }
polygon { 6, <0,-1>,<-1,-1>,<1,-1>,<1,1>,<-1,1>,<0,-1> translate <-2.2,-1.1,0> texture { Sides } interior_texture { Back } }
polygon { 5, <-1,-1>,<0.5,-0.5>,<0,1>,<-0.5,-0.5>,<-1,-1> scale <1,1,-1> translate <0,-1.1,0> texture { Sides } interior_texture { Back } }
polygon { 4, <-1,-1,0>,<1,-1,0.5>,<0,1,0.2>,<-1,-1,0> rotate 180*y translate <2.2,-1.1,0> texture { Sides } interior_texture { Back } }
