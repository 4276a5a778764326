// mistakes in lines 2, 4, 9, 11: four mistakes that have nothing to do with each other
#declare R = 1
#if (R = 1
  sphere { 0, R pigment { rbg 1 } }
#end
#macro Leg(H)
  cylinder { 0, H*y 0.1 }
#end
Leg(1, 2)
union {
  box { -1, 1 finish { phong 1 shininess 3 } }
  torus { 1, 0.2 }
}
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
