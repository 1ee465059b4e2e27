-- What the manual's pages need beyond pandoc: numbered equations that can be pointed at, links that lead to the
-- HTML pages, tables that scroll on a narrow screen.

local numbered = {} -- numbers of this page's equations

local function number_of(math)
  local formula, number = math.text:match("^(.-)%s*\\tag{([%d.]+)}%s*$")
  return formula or math.text, number
end

local function collect(math)
  local _, number = number_of(math)
  if number then numbered[number] = true end
end

local function equation(math)
  if math.mathtype == "InlineMath" then return pandoc.Span({math}, {class = "inline"}) end
  local formula, number = number_of(math)
  local parts = {pandoc.Math("DisplayMath", formula)}
  if number then table.insert(parts, pandoc.Span("(" .. number .. ")", {class = "number"})) end
  return pandoc.Span(parts, {class = "equation", id = number and "eq-" .. number or ""})
end

-- "(4.6)," becomes a link to that equation, where this page has it.
local function reference(str)
  local before, number, after = str.text:match("^(.*%()(%d+%.%d+)(%).*)$")
  if not number or not numbered[number] then return nil end
  return {pandoc.Str(before), pandoc.Link(number, "#eq-" .. number), pandoc.Str(after)}
end

local pictures = {svg = true, gif = true, png = true, csv = true, html = true}

local function link(l)
  local path, anchor = l.target:match("^([^#]*)(#?.*)$")
  if path == "" or path:match("^%a+:") then return nil end
  if path:match("/$") then path = path .. "README.md" end
  local extension = path:match("%.(%w+)$")
  if extension == "md" then
    path = path:gsub("md$", "html")
  elseif not pictures[extension] then
    path = path .. ".html" -- a source or a folder, shown on a page of its own
  end
  l.target = path .. anchor
  return l
end

local function scroll(t)
  return pandoc.Div({t}, {class = "scroll"})
end

return {{Math = collect}, {Math = equation, Str = reference, Link = link, Table = scroll}}
