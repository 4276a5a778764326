// mistake in line 3: a block that is open where the macro ends
#macro Post(H)
  cylinder { 0, H*y, 0.2 pigment { rgb 1 }
#end
Post(3)
Post(4)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
