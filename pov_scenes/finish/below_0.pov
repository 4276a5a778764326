// Diffuse light and highlights below 0 are left out, and so is a metallic below 0; ambient light, emission, mirror images and exponents
// below 0 count as they are.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -10> look_at 0 angle 46 }
light_source { <5, 8, -6>, rgb 1 }
light_source { <-6, 2, 4>, rgb <0.3, 0.5, 0.8> }
plane { -z, -3 pigment { checker rgb 1 rgb <0.4, 0.6, 0.4> } finish { ambient 0.3 diffuse 0.4 phong -1 } }
#macro Ball(Column, Row, Look)
  sphere { <Column*1.5, Row*1.5, 0>, 0.7 pigment { rgb <0.7, 0.4, 0.2> } finish { Look } }
#end
Ball(-2, 1.5, finish { phong -1 })
Ball(-1, 1.5, finish { specular -1 phong 0.5 })
Ball(0, 1.5, finish { diffuse -0.5 ambient 0.3 })
Ball(1, 1.5, finish { diffuse 0.5, -0.4 })
Ball(2, 1.5, finish { diffuse -0.5, 0.4 specular 0.5 })
Ball(-2, 0.5, finish { diffuse albedo -0.3 phong albedo -0.3 specular albedo -0.3 ambient 0.2 })
Ball(-1, 0.5, finish { specular 0.7 metallic -1 })
Ball(0, 0.5, finish { ambient -0.2 })
Ball(1, 0.5, finish { emission rgb <0.2, -0.3, 0> })
Ball(2, 0.5, finish { reflection -0.5 })
Ball(-2, -0.5, finish { reflection { -0.3, 0.5 } })
Ball(-1, -0.5, finish { reflection { 0.3 falloff -1 } })
Ball(0, -0.5, finish { reflection { 0.3 metallic -1 } })
Ball(1, -0.5, finish { brilliance -0.5 })
Ball(2, -0.5, finish { phong 0.5 phong_size -5 })
Ball(-2, -1.5, finish { specular 0.5 roughness -0.1 })
Ball(-1, -1.5, finish { irid { -0.3 thickness 0.5 } })
Ball(0, -1.5, finish { irid { 0.3 thickness -0.5 } })
Ball(1, -1.5, finish { crand -0.3 })
Ball(2, -1.5, finish { phong -1 metallic -1 diffuse -1 ambient 0.2 })
