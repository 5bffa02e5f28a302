-- For wrk: descriptions of Helsinki that were never said before, and which statuses came back, how fast the good ones.
local streets = {"Bulevardi", "Fredrikinkatu", "Annankatu", "Mannerheimintie", "Aleksanterinkatu", "Unioninkatu"}
local things = {"bank", "church", "hotel", "pharmacy", "cafe", "park", "statue", "tram stop"}
local threads = {}

function setup(thread)
  table.insert(threads, thread)
end

function init()
  math.randomseed(os.time())
  answered, refused, other = 0, 0, 0
end

function request()
  local text = string.format("I'm on %s, the %s on my left and a %s behind me %d", streets[math.random(#streets)],
    things[math.random(#things)], things[math.random(#things)], math.random(1000000000))
  return wrk.format("POST", "/localize", {["Content-Type"] = "application/json"}, '{"description": "' .. text .. '"}')
end

function response(status)
  if status == 200 then answered = answered + 1
  elseif status == 429 or status == 503 then refused = refused + 1
  else other = other + 1 end
end

function done(summary)
  local answered, refused, other = 0, 0, 0
  for _, thread in ipairs(threads) do
    answered = answered + thread:get("answered")
    refused = refused + thread:get("refused")
    other = other + thread:get("other")
  end
  io.write(string.format("%.1f answered a second; %d answered, %d refused (429, 503), %d other\n",
    answered / (summary.duration / 1e6), answered, refused, other))
end
